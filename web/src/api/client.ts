/** Calls to the REST API; every failure becomes a Refusal with words for a person. */
import { firstWords } from "@/language/catalogue";
import { words } from "@/words";
import { randomKey } from "./key";
import type {
  CarCommand,
  Job,
  JobPage,
  JobRequest,
  Playback,
  Reach,
  StopKind,
  VehicleList,
} from "./wire";

const ROOT = "/api/v1";
const PATIENCE_MS = 10_000;
const STOP_PATIENCE_MS = 3_000;
const START_ATTEMPTS = 3;
const PLAYBACK_PATIENCE_MS = 180_000;
const JOBS_SHOWN = 12;

/** The parts of a problem document that the page shows. */
export interface Trouble {
  readonly code: string;
  readonly title: string;
  readonly detail: string;
  readonly remedy: string;
  /** Facts of this occurrence, by name with unit. */
  readonly context?: Readonly<Record<string, unknown>>;
}

/** The server said no, or could not be asked. */
export class Refusal extends Error {
  constructor(
    readonly trouble: Trouble,
    /** False when no answer came: the request may or may not have been carried out. */
    readonly answered: boolean,
  ) {
    super(trouble.detail);
    this.name = "Refusal";
  }
}

interface Call {
  readonly method?: "GET" | "POST" | "PUT" | "PATCH" | "DELETE";
  readonly body?: unknown;
  readonly headers?: Record<string, string>;
  readonly patienceMs?: number;
  /** Hears the version of the answer, for a change that must not overwrite another. */
  readonly onVersion?: (etag: string) => void;
}

/**
 * One call.
 *
 * @throws Refusal when the server says no, or cannot be asked.
 */
export async function call<Answer>(path: string, options: Call = {}): Promise<Answer> {
  const { method = "GET", body, headers = {}, patienceMs = PATIENCE_MS, onVersion } = options;
  const request: RequestInit = { method, headers, signal: AbortSignal.timeout(patienceMs) };
  if (body !== undefined) {
    request.body = JSON.stringify(body);
    request.headers = { "Content-Type": "application/json", ...headers };
  }
  let response: Response;
  let text: string;
  try {
    response = await fetch(ROOT + path, request);
    text = await response.text();
  } catch {
    await firstWords;
    throw new Refusal(words.trouble.unreachable, false);
  }
  if (!response.ok) {
    await firstWords;
    throw new Refusal(troubleIn(text), true);
  }
  onVersion?.(response.headers.get("ETag") ?? "");
  return (text === "" ? undefined : JSON.parse(text)) as Answer;
}

/** Reads a problem document; anything else (a proxy's page, say) gets general words. */
function troubleIn(text: string): Trouble {
  try {
    const found = JSON.parse(text) as Partial<Trouble> | null;
    if (typeof found?.title === "string" && typeof found.detail === "string") {
      const { code = "unknown", title, detail, remedy = "", context } = found;
      return { code, title, detail, remedy, ...(context !== undefined && { context }) };
    }
  } catch {
    // Not JSON: the general words below are all that can be said.
  }
  return words.trouble.unexpected;
}

/**
 * Starts a job. Lost answers are asked for again under the same key, so that the robot never
 * starts twice.
 */
export async function startJob(job: JobRequest): Promise<Job> {
  const headers = { "Idempotency-Key": randomKey() };
  for (let attempt = 1; ; attempt += 1) {
    try {
      return await call<Job>("/jobs", { method: "POST", body: job, headers });
    } catch (error) {
      const lost = error instanceof Refusal && !error.answered;
      if (!lost || attempt === START_ATTEMPTS) throw error;
    }
  }
}

export const cancelJob = (id: string): Promise<Job> =>
  call(`/jobs/${encodeURIComponent(id)}/cancel`, { method: "POST" });

/** Brings a job to rest until it is resumed. */
export const pauseJob = (id: string): Promise<Job> =>
  call(`/jobs/${encodeURIComponent(id)}/pause`, { method: "POST" });

/** Lets a paused job, or one that has asked a person, go on. */
export const resumeJob = (id: string): Promise<Job> =>
  call(`/jobs/${encodeURIComponent(id)}/resume`, { method: "POST" });

/** Ends charging now and unplugs. */
export const finishJob = (id: string): Promise<Job> =>
  call(`/jobs/${encodeURIComponent(id)}/finish`, { method: "POST" });

/** Jobs, newest first. */
export const listJobs = (): Promise<JobPage> => call(`/jobs?limit=${String(JOBS_SHOWN)}`);

/** Makes a recorded job ready to be watched; the first time takes some seconds. */
export const preparePlayback = (id: string): Promise<Playback> =>
  call(`/jobs/${encodeURIComponent(id)}/playback`, { patienceMs: PLAYBACK_PATIENCE_MS });

/** How far each axis can still go from here. */
export const readReach = (): Promise<Reach> => call("/robot/reach");

export const listVehicles = (): Promise<VehicleList> => call("/vehicles");

export const confirmPlugIsOut = (): Promise<unknown> =>
  call("/robot/plug-confirmation", { method: "POST", body: { state: "free" } });

export type RobotCommand = "home" | "enable" | "disable" | "reset";

export const commandRobot = (command: RobotCommand): Promise<unknown> =>
  call(`/robot/${command}`, { method: "POST" });

/** Tells the simulated car what to do. */
export const commandSimulatedCar = (command: CarCommand): Promise<unknown> =>
  call("/simulation/car", { method: "POST", body: command });

export const stopByRest = (kind: StopKind): Promise<unknown> =>
  call(kind === "stop" ? "/robot/stop" : "/robot/estop", {
    method: "POST",
    patienceMs: STOP_PATIENCE_MS,
  });
