/** The words of the home page, its guidance and the access pages: one file for each language. */
import { catalogue } from "./catalogue";
import type { Language } from "./language";
import type { AccessWords, GuidanceWords, HomeWords } from "./types";

interface File {
  readonly home: HomeWords;
  readonly access: AccessWords;
  readonly guidance: GuidanceWords;
}

const FILES: Readonly<Record<Language, () => Promise<File>>> = {
  en: () => import("./en"),
  fr: () => import("./fr"),
  de: () => import("./de"),
  it: () => import("./it"),
};

export const home = catalogue<HomeWords>(async (spoken) => (await FILES[spoken]()).home);
export const access = catalogue<AccessWords>(async (spoken) => (await FILES[spoken]()).access);
export const guidance = catalogue<GuidanceWords>(async (spoken) => (await FILES[spoken]()).guidance);
