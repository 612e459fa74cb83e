/** Which language the page speaks: the browser's, until somebody chooses another. */
import { computed, signal } from "@preact/signals";

export const LANGUAGES = ["en", "fr", "de", "it"] as const;
export type Language = (typeof LANGUAGES)[number];

/** Each language in its own words. */
export const LANGUAGE_NAMES: Readonly<Record<Language, string>> = {
  en: "English",
  fr: "Français",
  de: "Deutsch",
  it: "Italiano",
};

/** How numbers and dates are written where the browser names no region. */
const REGIONS: Readonly<Record<Language, string>> = {
  en: "en-GB",
  fr: "fr-FR",
  de: "de-DE",
  it: "it-IT",
};

const KEPT_AS = "plugpilot.language";

/** The language in force; set by `speak` alone, when all its words are there. */
export const language = signal<Language>("en");

/** The language with its region, as Intl wants it: somebody in Zurich writes 1’000. */
export const locale = computed(() => regional(language.value, navigator.languages));

/** The reader's own form of a language, if the browser names one. */
export function regional(spoken: Language, wanted: readonly string[]): string {
  return wanted.find((tag) => tag.startsWith(`${spoken}-`)) ?? REGIONS[spoken];
}

/** The choice that was kept; else the first language of the browser that is spoken here. */
export function preferred(): Language {
  return kept() ?? firstSpoken(navigator.languages);
}

export function firstSpoken(wanted: readonly string[]): Language {
  for (const tag of wanted) {
    const base = tag.toLowerCase().split("-")[0];
    const spoken = LANGUAGES.find((each) => each === base);
    if (spoken !== undefined) return spoken;
  }
  return "en";
}

/** Keeps a choice for the next visit. */
export function keep(chosen: Language): void {
  try {
    localStorage.setItem(KEPT_AS, chosen);
  } catch {
    // A browser that keeps nothing asks its own language again: there is nothing to tell.
  }
}

function kept(): Language | null {
  try {
    const found = localStorage.getItem(KEPT_AS);
    return LANGUAGES.find((each) => each === found) ?? null;
  } catch {
    return null; // As in keep.
  }
}

interface Forms {
  readonly one: string;
  readonly other: string;
}

/**
 * One passkey, two passkeys: which form a count takes is the language's own affair.
 *
 * The number stands where # is.
 */
export function pluralIn(spoken: Language): (count: number, forms: Forms) => string {
  const rules = new Intl.PluralRules(spoken);
  const numbers = new Intl.NumberFormat(spoken);
  return (count, forms) => {
    const form = rules.select(count) === "one" ? forms.one : forms.other;
    return form.replace("#", numbers.format(count));
  };
}
