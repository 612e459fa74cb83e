/** Live states for the tests, and every value that the published API allows. */
import openapi from "../../web/openapi.json";
import type {
  DeltaMessage,
  Job,
  JobPhase,
  JobState,
  JobType,
  Live,
  PlugState,
  Robot,
  RobotMode,
  SnapshotMessage,
  Station,
} from "@/api/wire";

const { schemas } = openapi.components;

export const MODES = schemas.RobotMode.enum as RobotMode[];
export const PLUGS = schemas.PlugState.enum as PlugState[];
export const TYPES = schemas.JobType.enum as JobType[];
export const STATES = schemas.JobState.enum as JobState[];
export const PHASES = schemas.JobPhase.enum as JobPhase[];

export const START = "2026-03-01T18:00:00Z";

/** The date so many seconds after START. */
export const at = (seconds: number): string =>
  new Date(Date.parse(START) + seconds * 1000).toISOString();

export function robot(changes: Partial<Robot> = {}): Robot {
  return {
    mode: "ready",
    driver: "Simulator",
    plug: "parked",
    enabled: true,
    homed: true,
    measured: { joints: { rho1_mm: 1, rho2_mm: 2, rho3_mm: 3 }, tip: null, force_n: 0 },
    commanded: null,
    control: null,
    fault: null,
    socket: null,
    updated_at: START,
    ...changes,
  };
}

export function job(changes: Partial<Job> = {}): Job {
  return {
    id: "job-1",
    type: "charge",
    state: "running",
    phase: "locating",
    vehicle_id: "zoe",
    target_energy_wh: null,
    created_at: START,
    updated_at: START,
    phase_started_at: START,
    cancel_requested: false,
    result: {},
    error: null,
    ...changes,
  };
}

export function station(changes: Partial<Station> = {}): Station {
  return {
    name: "Simulator",
    online: true,
    pilot: "A",
    enabled: false,
    held: false,
    contactor_closed: false,
    connector_locked: false,
    power_w: 0,
    currents_a: [0, 0, 0],
    session_energy_wh: 0,
    updated_at: START,
    ...changes,
  };
}

export function live(changes: Partial<Live> = {}): Live {
  return {
    robot: robot(),
    job: null,
    station: station(),
    service: {
      version: "0.1.0",
      simulated: true,
      simulated_parts: ["robot", "camera", "station"],
      speed: 10,
      camera_online: true,
      started_at: START,
    },
    twin: { divergences: [] },
    guidance: null,
    queue: { waiting: null },
    calibration: {},
    ...changes,
  };
}

export const snapshot = (state: Live, sequence = 1): SnapshotMessage => ({
  type: "snapshot",
  version: 1,
  sequence,
  stale_after_s: 1,
  live: state,
});

export const delta = (changes: DeltaMessage["changes"], sequence: number): DeltaMessage => ({
  type: "delta",
  sequence,
  changes,
});
