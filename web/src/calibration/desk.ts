/** What the panel shows, and what its buttons do. */
import { computed, signal } from "@preact/signals";
import { call, listVehicles, Refusal } from "@/api/client";
import type { Trouble } from "@/api/client";
import type { Vehicle } from "@/api/wire";
import { store } from "@/live/page";
import { download } from "@/technician/parts/download";
import { keep, kept } from "@/technician/parts/kept";
import { fetchReport } from "./report";
import type {
  AccuracyCheck,
  AccuracyCheckPage,
  Calibration,
  CalibrationDetail,
  CalibrationPage,
  Drift,
  Hint,
  Routine,
  RoutineKind,
} from "./types";

const SHOWN = 20;
const VIEW_KEPT_AS = "plugpilot.calibration.view";
const READ_KEPT_AS = "plugpilot.calibration.read";

/** What somebody has opened. */
export type View =
  | { readonly what: "overview" }
  | { readonly what: "guide"; readonly kind: RoutineKind }
  | { readonly what: "version"; readonly id: string }
  | { readonly what: "check"; readonly id: string };

const OVERVIEW: View = { what: "overview" };

/** Outlives a reload, as the routine itself does. */
export const view = signal<View>(keptView());
export const trouble = signal<Trouble | null>(null);
export const busy = signal(false);
export const versions = signal<readonly Calibration[] | null>(null);
export const checks = signal<readonly AccuracyCheck[] | null>(null);
export const vehicles = signal<readonly Vehicle[]>([]);
const nextCursor = signal<string | null>(null);
export const hasOlder = computed(() => nextCursor.value !== null);
/** When the routine was begun whose end somebody has read. */
const read = signal(kept("localStorage", READ_KEPT_AS) ?? "");

export const inForce = computed(() => store.live.value?.calibration?.in_force ?? null);
export const routine = computed((): Routine | null => store.live.value?.calibration?.routine ?? null);
/** What jobs have shown of the belts; null before any has. */
export const drift = computed((): Drift | null => store.live.value?.calibration?.drift ?? null);
/** What wears, or has moved. */
export const hints = computed((): readonly Hint[] => store.live.value?.calibration?.hints ?? []);
/** The routine, unless it has ended and somebody has read how. */
export const unread = computed(() => (routine.value?.begun_at === read.value ? null : routine.value));
export const isUnderWay = ({ state }: Routine): boolean => state === "running" || state === "interrupted";
/** Whatever makes the lists old. */
export const edition = computed(() => {
  const counting = inForce.value;
  const { camera, robot, switches, play, force, sockets = [] } = counting ?? {};
  const ids = [camera, robot, switches, play, force, ...sockets].map((each) => each?.id ?? "");
  return [routine.value?.calibration_id ?? "", routine.value?.check_id ?? "", ...ids].join();
});

export function open(next: View): void {
  trouble.value = null;
  view.value = next;
  keep("sessionStorage", VIEW_KEPT_AS, JSON.stringify(next));
}

export const close = (): void => open(OVERVIEW);

/** The end of the routine has been read: another look at the page shows it no more. */
export function putAway(): void {
  read.value = routine.value?.begun_at ?? "";
  keep("localStorage", READ_KEPT_AS, read.value);
  close();
}

export const loadLists = (): Promise<void> =>
  attempt(async () => {
    const page = await call<CalibrationPage>(`/calibrations?limit=${String(SHOWN)}`);
    versions.value = page.items;
    nextCursor.value = page.next_cursor ?? null;
    checks.value = (await call<AccuracyCheckPage>(`/calibrations/checks?limit=${String(SHOWN)}`)).items;
    vehicles.value = (await listVehicles()).items;
  });

export const loadOlder = (): Promise<void> =>
  attempt(async () => {
    const cursor = encodeURIComponent(nextCursor.value ?? "");
    const page = await call<CalibrationPage>(`/calibrations?limit=${String(SHOWN)}&cursor=${cursor}`);
    versions.value = [...(versions.value ?? []), ...page.items];
    nextCursor.value = page.next_cursor ?? null;
  });

/** One version with what it rests on; null when it could not be read. */
export async function readVersion(id: string): Promise<CalibrationDetail | null> {
  let found: CalibrationDetail | null = null;
  await attempt(async () => {
    found = await call<CalibrationDetail>(`/calibrations/${encodeURIComponent(id)}`);
  });
  return found;
}

export const begin = (body: unknown): Promise<void> => act("/calibrations/routine", body);
/** Answers what the routine asks; the value is null where it is enough to confirm. */
export const answer = (code: string, value: number | null): Promise<void> =>
  act("/calibrations/routine/confirm", { code, value });
export const resume = (): Promise<void> => act("/calibrations/routine/resume");
export const cancel = (): Promise<void> => act("/calibrations/routine/cancel");
export const activate = (id: string, acceptWorse: boolean): Promise<void> =>
  act(`/calibrations/${encodeURIComponent(id)}/activation`, { accept_worse: acceptWorse });

/** Goes back to the version before, or to what is configured. */
export function rollBack({ kind, values }: Calibration): Promise<void> {
  const vehicle_id = values.kind === "socket" ? values.vehicle_id : null;
  return act("/calibrations/roll-back", { kind, vehicle_id });
}

/** The report on paper; a refusal is told like any other. */
export async function downloadReport({ id, made_at }: AccuracyCheck): Promise<void> {
  if (busy.value) return;
  busy.value = true;
  await attempt(async () => download(await fetchReport(id), `plugpilot-check-${made_at.slice(0, 10)}.pdf`));
  busy.value = false;
}

async function act(path: string, body?: unknown): Promise<void> {
  if (busy.value) return;
  busy.value = true;
  await attempt(() => call(path, body === undefined ? { method: "POST" } : { method: "POST", body }));
  busy.value = false;
}

async function attempt(work: () => Promise<void>): Promise<void> {
  trouble.value = null;
  try {
    await work();
  } catch (error) {
    if (!(error instanceof Refusal)) throw error;
    trouble.value = error.trouble;
  }
}

function keptView(): View {
  try {
    return (JSON.parse(kept("sessionStorage", VIEW_KEPT_AS) ?? "null") as View | null) ?? OVERVIEW;
  } catch {
    return OVERVIEW; // something else of that name: nothing worth keeping
  }
}
