/** Asks again and again for as long as somebody looks; a hidden page asks nothing. */
import { Refusal } from "@/api/client";
import type { Trouble } from "@/api/client";

const AFTER_TROUBLE_MS = 1500;
const WHILE_HIDDEN_MS = 500;

/**
 * Asks until it is told to end.
 *
 * @param ask One question and what is done with its answer; takes its time by itself.
 * @param fail Hears why there was no answer.
 * @param pauseMs Between two questions.
 */
export function poll(ask: () => Promise<void>, fail: (trouble: Trouble) => void, pauseMs = 0): () => void {
  let ended = false;
  const run = async (): Promise<void> => {
    while (!ended) {
      if (document.visibilityState !== "visible") {
        await pause(WHILE_HIDDEN_MS);
        continue;
      }
      try {
        await ask();
        await pause(pauseMs);
      } catch (error) {
        if (!(error instanceof Refusal)) throw error;
        if (!ended) fail(error.trouble);
        await pause(AFTER_TROUBLE_MS);
      }
    }
  };
  void run();
  return () => {
    ended = true;
  };
}

const pause = (ms: number): Promise<void> => new Promise((resolve) => setTimeout(resolve, ms));
