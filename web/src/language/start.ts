/** Speaking: when the page opens, and when somebody chooses another language. */
import { isUnloadable } from "@/api/late";
import { speak } from "./catalogue";
import { keep, preferred } from "./language";
import type { Language } from "./language";
import { loadProblems } from "./problems";

const AGAIN_MS = 2000;

/**
 * Speaks the reader's language.
 *
 * Without its words there is no page. They are away when the connection broke meanwhile, or when
 * the server was updated between the page and its words: opening the page anew mends both.
 */
export async function speakPreferred(): Promise<void> {
  if (await spoke(preferred())) return;
  setTimeout(() => location.reload(), AGAIN_MS);
}

/** Speaks another language from now on; false when its words cannot be had now. */
export async function choose(next: Language): Promise<boolean> {
  if (!(await spoke(next))) return false;
  keep(next);
  return true;
}

async function spoke(next: Language): Promise<boolean> {
  try {
    await speak(next);
  } catch (error) {
    if (isUnloadable(error)) return false;
    throw error;
  }
  // Problems are said in English until their words are there, and for good when they are not.
  loadProblems().catch((error: unknown) => {
    if (!isUnloadable(error)) throw error;
  });
  return true;
}
