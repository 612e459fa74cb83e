/** Every sentence of the guides, loaded with the first guide. */
import { catalogueNow } from "@/language/catalogue";
import type { Language } from "@/language/language";
import type { GuideWords } from "@/language/types";

const FILES: Readonly<Record<Language, () => Promise<{ readonly guides: GuideWords }>>> = {
  en: () => import("@/language/en/guides"),
  fr: () => import("@/language/fr/guides"),
  de: () => import("@/language/de/guides"),
  it: () => import("@/language/it/guides"),
};

const loading = catalogueNow<GuideWords>(async (spoken) => (await FILES[spoken]()).guides);

export let say: GuideWords;

/** The words are there when this has come true. */
export const ready = loading.then((words) => {
  say = words;
});
