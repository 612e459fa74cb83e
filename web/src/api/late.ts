/** Parts of the page that are loaded when they are asked for. */
import { words } from "@/words";
import { Refusal } from "./client";

/**
 * Waits for a part.
 *
 * @throws Refusal when it cannot be had now: the connection broke, or the server was updated and
 *   the page is an older one.
 */
export async function late<Part>(loading: Promise<Part>): Promise<Part> {
  try {
    return await loading;
  } catch (error) {
    if (isUnloadable(error)) throw new Refusal(words.trouble.unreachable, false);
    throw error;
  }
}

/** How browsers say that a module could not be fetched. */
export const isUnloadable = (error: unknown): boolean => error instanceof TypeError;
