/** Asks for one look of the camera after the other, each with its picture. */
import { call } from "@/api/client";
import type { Trouble } from "@/api/client";
import type { CameraInspection } from "@/api/wire";
import { poll } from "../parts/poll";

const PATIENCE_MS = 6000;
const FORGET_AFTER_MS = 500;

/** A look and the picture it was made in; the two belong together. */
export interface Pictured<Look> {
  readonly look: Look;
  /** Address of the picture, good until the next one is shown. */
  readonly picture: string;
}

export interface Watcher<Look> {
  show(shown: Pictured<Look>): void;
  fail(trouble: Trouble): void;
}

/**
 * Watches until it is told to end.
 *
 * @param root Where looks are asked for; their pictures are below it, by their numbers.
 */
export function followPictures<Look extends { readonly sequence: number }>(root: string, watcher: Watcher<Look>): () => void {
  let known = 0;
  let address = "";
  let ended = false;
  const ask = async (): Promise<void> => {
    const look = await call<Look>(`${root}?after=${String(known)}`, { patienceMs: PATIENCE_MS });
    known = look.sequence;
    const picture = await pictureOf(root, known);
    if (ended || picture === null) return;
    forgetLater(address);
    address = URL.createObjectURL(picture);
    watcher.show({ look, picture: address });
  };
  const end = poll(ask, (trouble) => {
    known = 0;
    watcher.fail(trouble);
  });
  return () => {
    ended = true;
    forgetLater(address);
    end();
  };
}

/** What is found in the camera's pictures, and the picture it was found in. */
export interface Shown {
  readonly inspection: CameraInspection;
  readonly picture: string;
}

/** Watches the camera until it is told to end. */
export function follow(watcher: { show(shown: Shown): void; fail(trouble: Trouble): void }): () => void {
  return followPictures<CameraInspection>("/camera/inspection", {
    show: ({ look, picture }) => watcher.show({ inspection: look, picture }),
    fail: (trouble) => watcher.fail(trouble),
  });
}

function forgetLater(address: string): void {
  if (address !== "") setTimeout(() => URL.revokeObjectURL(address), FORGET_AFTER_MS);
}

/** The picture; null when a newer one has taken its place meanwhile, or nobody answered. */
async function pictureOf(root: string, sequence: number): Promise<Blob | null> {
  try {
    const response = await fetch(`/api/v1${root}/${String(sequence)}.jpg`, {
      signal: AbortSignal.timeout(PATIENCE_MS),
    });
    return response.ok ? await response.blob() : null;
  } catch {
    return null;
  }
}
