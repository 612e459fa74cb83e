/** Fetches the diagnostics; they are no JSON, so the usual call will not do. */
import { Refusal } from "@/api/client";
import type { Trouble } from "@/api/client";
import { say } from "./words";

const PATIENCE_MS = 60_000;

export interface Bundle {
  readonly content: Blob;
  readonly name: string;
}

/** @throws Refusal when the server says no, or does not answer. */
export async function fetchBundle(): Promise<Bundle> {
  let response: Response;
  try {
    response = await fetch("/api/v1/diagnostics.zip", { signal: AbortSignal.timeout(PATIENCE_MS) });
    if (response.ok) return { content: await response.blob(), name: nameIn(response.headers) };
  } catch {
    throw new Refusal(say.unreachable, false);
  }
  const problem = (await response.json().catch(() => say.unreachable)) as Trouble;
  throw new Refusal(problem, true);
}

const nameIn = (headers: Headers): string =>
  /filename="([\w.-]+)"/.exec(headers.get("Content-Disposition") ?? "")?.[1] ?? say.file;
