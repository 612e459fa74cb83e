/** Who this browser is to the robot, and how it becomes somebody. */
import { effect, signal } from "@preact/signals";
import type { Signal } from "@preact/signals";
import { Refusal } from "@/api/client";
import type { Trouble } from "@/api/client";
import { speakPreferred } from "@/language/start";
import { connect, store } from "@/live/page";
import { getSession, pairDevice } from "./calls";
import type { Right, Session } from "./calls";

const FRAGMENT = /^#pair=([\w-]{10,128})$/;
const AGAIN_MS = 1500;

/** Null until the server has said. */
export const session: Signal<Session | null> = signal(null);
/** The secret of an invitation that waits for a yes, because this browser is paired already. */
export const waitingInvitation: Signal<string | null> = signal(null);
/** The robot has not answered since this page was opened. */
export const unanswered = signal(false);
/** Why the last attempt to get in failed. */
export const doorTrouble: Signal<Trouble | null> = signal(null);

/** Whether the dialog about people and devices is open. */
export const menuOpen = signal(false);

let connected = false;

/** Whether whoever sits here may do something; before the server has said, nothing is hidden. */
export const may = (right: Right): boolean => session.value?.rights.includes(right) ?? true;

/** The secret in the address of an invitation. */
export function secretIn(text: string): string | null {
  const at = text.indexOf("#");
  return FRAGMENT.exec(at < 0 ? text : text.slice(at))?.[1] ?? null;
}

/** Speaks, asks who this browser is, uses the invitation in the address, and watches for the end. */
export async function begin(): Promise<void> {
  addEventListener("hashchange", () => void openInvitation());
  // A lost connection may mean that this device was removed.
  effect(() => {
    if (store.link.value === "lost") void check();
  });
  await Promise.all([speakPreferred(), check()]);
  await openInvitation();
}

/** Uses an invitation: this browser becomes a device of the person who is invited. */
export async function useInvitation(secret: string): Promise<void> {
  waitingInvitation.value = null;
  await attempt(async () => enter(await pairDevice(secret)));
}

/** Something that may let this browser in; what goes wrong is shown at the door. */
export async function attempt(work: () => Promise<void>): Promise<void> {
  doorTrouble.value = null;
  try {
    await work();
  } catch (error) {
    if (!(error instanceof Refusal)) throw error;
    doorTrouble.value = error.trouble;
  }
}

/** Takes what the server says about this browser. */
export function enter(now: Session): void {
  session.value = now;
  if (!now.paired || connected) return;
  connected = true;
  connect();
}

async function openInvitation(): Promise<void> {
  const secret = secretIn(location.hash);
  if (secret === null) return;
  // Out of the address bar and the history at once: it is a secret, and used up soon.
  history.replaceState(null, "", location.pathname + location.search);
  if (session.value?.paired === true) waitingInvitation.value = secret;
  else await useInvitation(secret);
}

async function check(): Promise<void> {
  try {
    enter(await getSession());
    unanswered.value = false;
  } catch (error) {
    if (!(error instanceof Refusal)) throw error;
    unanswered.value = session.value === null;
    // The server is away; until it is back nobody can say who this is.
    if (session.value === null || store.link.value === "lost") {
      setTimeout(() => void check(), AGAIN_MS);
    }
  }
}
