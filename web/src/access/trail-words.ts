/** What the trail says, loaded when it is opened first. */
import { catalogueNow } from "@/language/catalogue";
import type { Language } from "@/language/language";
import type { TrailWords } from "@/language/types";

const FILES: Readonly<Record<Language, () => Promise<{ readonly trail: TrailWords }>>> = {
  en: () => import("@/language/en/trail"),
  fr: () => import("@/language/fr/trail"),
  de: () => import("@/language/de/trail"),
  it: () => import("@/language/it/trail"),
};

let loading: Promise<TrailWords> | null = null;

/** Comes true when they are there. A failed attempt is made again at the next opening. */
export function trailWords(): Promise<TrailWords> {
  loading ??= catalogueNow<TrailWords>(async (spoken) => (await FILES[spoken]()).trail).catch(
    (error: unknown) => {
      loading = null;
      throw error;
    },
  );
  return loading;
}
