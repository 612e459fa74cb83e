/** Fetches a report; it is no JSON, so the usual call will not do. */
import { Refusal } from "@/api/client";
import type { Trouble } from "@/api/client";
import { firstWords } from "@/language/catalogue";
import { words } from "@/words";

/** What draws is loaded for the first report only, which takes a small machine a while. */
const PATIENCE_MS = 60_000;

/** @throws Refusal when the server says no, or does not answer. */
export async function fetchReport(checkId: string): Promise<Blob> {
  let response: Response;
  try {
    const path = `/api/v1/calibrations/checks/${encodeURIComponent(checkId)}/report.pdf`;
    response = await fetch(path, { signal: AbortSignal.timeout(PATIENCE_MS) });
    if (response.ok) return await response.blob();
  } catch {
    await firstWords;
    throw new Refusal(words.trouble.unreachable, false);
  }
  await firstWords;
  const problem = (await response.json().catch(() => words.trouble.unexpected)) as Trouble;
  throw new Refusal(problem, true);
}
