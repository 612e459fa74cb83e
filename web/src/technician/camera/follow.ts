/** Asks for one inspection after the other, each with its picture. */
import { call } from "@/api/client";
import type { Trouble } from "@/api/client";
import type { CameraInspection } from "@/api/wire";
import { poll } from "../parts/poll";

const PATIENCE_MS = 6000;
const FORGET_AFTER_MS = 500;

/** What is found and the picture it was found in; the two belong together. */
export interface Shown {
  readonly inspection: CameraInspection;
  /** Address of the picture, good until the next one is shown. */
  readonly picture: string;
}

export interface Watcher {
  show(shown: Shown): void;
  fail(trouble: Trouble): void;
}

/** Watches until it is told to end. */
export function follow(watcher: Watcher): () => void {
  let known = 0;
  let address = "";
  let ended = false;
  const ask = async (): Promise<void> => {
    const path = `/camera/inspection?after=${String(known)}`;
    const inspection = await call<CameraInspection>(path, { patienceMs: PATIENCE_MS });
    known = inspection.sequence;
    const picture = await pictureOf(known);
    if (ended || picture === null) return;
    forgetLater(address);
    address = URL.createObjectURL(picture);
    watcher.show({ inspection, picture: address });
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

function forgetLater(address: string): void {
  if (address !== "") setTimeout(() => URL.revokeObjectURL(address), FORGET_AFTER_MS);
}

/** The picture; null when a newer one has taken its place meanwhile, or nobody answered. */
async function pictureOf(sequence: number): Promise<Blob | null> {
  try {
    const response = await fetch(`/api/v1/camera/inspection/${String(sequence)}.jpg`, {
      signal: AbortSignal.timeout(PATIENCE_MS),
    });
    return response.ok ? await response.blob() : null;
  } catch {
    return null;
  }
}
