/** The words of the technician's page: one file for each language, loaded with that page only. */
import { catalogue } from "@/language/catalogue";
import type { Language } from "@/language/language";
import type {
  BenchWords,
  CalibrationWords,
  CameraWords,
  ConfigWords,
  ConsoleWords,
  DiagnosticsWords,
  LinkWords,
  Spoken,
  TargetWords,
} from "./types";

const FILES: Readonly<Record<Language, () => Promise<Spoken>>> = {
  en: () => import("./en"),
  fr: () => import("./fr"),
  de: () => import("./de"),
  it: () => import("./it"),
};

export const bench = catalogue<BenchWords>(async (spoken) => (await FILES[spoken]()).bench);
export const calibration = catalogue<CalibrationWords>(
  async (spoken) => (await FILES[spoken]()).calibration,
);
export const camera = catalogue<CameraWords>(async (spoken) => (await FILES[spoken]()).camera);
export const config = catalogue<ConfigWords>(async (spoken) => (await FILES[spoken]()).config);
export const console = catalogue<ConsoleWords>(async (spoken) => (await FILES[spoken]()).console);
export const diagnostics = catalogue<DiagnosticsWords>(
  async (spoken) => (await FILES[spoken]()).diagnostics,
);
export const link = catalogue<LinkWords>(async (spoken) => (await FILES[spoken]()).link);
export const target = catalogue<TargetWords>(async (spoken) => (await FILES[spoken]()).target);
