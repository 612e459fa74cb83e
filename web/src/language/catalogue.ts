/**
 * Words that change with the language.
 *
 * A page writes `words.state.ready.headline`. Read inside a component or a computed signal, the
 * words are followed: another language shows itself everywhere at once, and nothing is loaded
 * anew. Do not keep a part of them in a module's constant; it would stay in the first language.
 */
import { batch, signal } from "@preact/signals";
import { language } from "./language";
import type { Language } from "./language";

type Put = () => void;

/** Whether the words of any language are there. */
export const speaking = signal(false);

const catalogues: ((spoken: Language) => Promise<Put>)[] = [];

/**
 * A set of words in every language, each loaded when it is spoken.
 *
 * The type is that of the English words, so that a sentence missing in another language does not
 * compile:
 *
 *     export const say = catalogue<Words>(async (spoken) => (await files[spoken]()).words);
 */
export function catalogue<Words extends object>(load: (spoken: Language) => Promise<Words>): Words {
  return register(load).words;
}

/** The same for a part of a page that is loaded late: comes true when its words are there. */
export async function catalogueNow<Words extends object>(
  load: (spoken: Language) => Promise<Words>,
): Promise<Words> {
  const { words, loadFor } = register(load);
  let spoken: Language;
  do {
    spoken = language.value;
    (await loadFor(spoken))();
  } while (spoken !== language.value); // somebody chose another one meanwhile
  return words;
}

interface Registered<Words> {
  readonly words: Words;
  readonly loadFor: (spoken: Language) => Promise<Put>;
}

function register<Words extends object>(
  load: (spoken: Language) => Promise<Words>,
): Registered<Words> {
  const inForce = signal<Words | null>(null);
  const loadFor = async (spoken: Language): Promise<Put> => {
    const loaded = await load(spoken);
    return () => {
      inForce.value = loaded;
    };
  };
  catalogues.push(loadFor);
  const words = new Proxy({} as Words, {
    get: (_, section) => {
      if (inForce.value === null) throw new Error("no language is spoken yet");
      return Reflect.get(inForce.value, section) as unknown;
    },
  });
  return { words, loadFor };
}

let announce: () => void;

/** Comes true when the first words are there: what happens before has nothing to say it with. */
export const firstWords = new Promise<void>((resolve) => {
  announce = resolve;
});

/** Loads all words of a language, then speaks it everywhere at once. */
export async function speak(next: Language): Promise<void> {
  const loaded = await Promise.all(catalogues.map((load) => load(next)));
  batch(() => {
    for (const put of loaded) put();
    language.value = next;
    speaking.value = true;
  });
  announce();
  document.documentElement.lang = next;
}
