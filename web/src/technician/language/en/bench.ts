/** What the technician's page says outside its panels. */
import type { JogAxis, RobotMode } from "@/api/wire";
import { formatNumber } from "@/format";
import type { Direction } from "../../jog/axes";
import type { BenchProblems } from "../told";

type NotReady = Exclude<RobotMode, "ready" | "moving">;

const not: Record<NotReady, string> = {
  offline: "The robot does not answer.",
  off: "The drives are off: switch them on first.",
  not_homed: "The position is not known: find it first.",
  homing: "The robot is finding its position.",
  stopping: "The robot is coming to rest.",
  stopped: "Somebody pressed Stop: release it first.",
  emergency_stop: "Emergency stop: release it first.",
  fault: "There is a fault: release it first.",
};

const ways: Record<JogAxis, Record<Direction, string>> = {
  x: { [-1]: "Back along the rail", 1: "On along the rail" },
  y: { [-1]: "Down", 1: "Up" },
  insertion: { [-1]: "Away from the car", 1: "To the car" },
  rho1: { [-1]: "Left carriage back", 1: "Left carriage on" },
  rho2: { [-1]: "Right carriage back", 1: "Right carriage on" },
  rho3: { [-1]: "Slide in", 1: "Slide out" },
};

export const bench = {
  title: "Technician",
  panel: {
    loading: "Loading…",
    away: "This part could not be loaded. Reload the page.",
  },
  robot: {
    title: "Robot",
    enable: "Switch drives on",
    disable: "Switch drives off",
    find: "Find position",
    release: "Release",
    control: "In control",
    nobody: "nobody",
  },
  jog: {
    title: "Move by hand",
    frame: "Directions",
    frames: { base: "Plug", joints: "Joints" },
    amount: "How far, mm",
    hold: "While held",
    speed: "Speed, mm/s",
    axes: { x: "x", y: "y", insertion: "Insertion", rho1: "ρ1", rho2: "ρ2", rho3: "ρ3" },
    ways,
    keys: "Keys: arrows and Page Up, Page Down while this box has the focus.",
    gamepad: "Gamepad: hold L1 and push a stick. Releasing L1 stops.",
    left: (way_mm: number): string => (way_mm === 0 ? "end" : `${formatNumber(way_mm, 0)} mm`),
    notAllowed: "You may look. Only a technician or an owner may move the robot here.",
    notLive: "The page has no fresh values.",
    busy: "The robot is moving.",
    controlled: (name: string): string => `${name} has control.`,
    onlyOut: "The plug may be in a socket: only the way out is open.",
    ready: "Ready. The robot moves only while you hold a button.",
    readyStep: "Ready. Each press moves one step.",
    not,
    noAnswer: {
      code: "no_answer",
      title: "No answer",
      detail: "The robot did not answer, so the motion was ended.",
      remedy: "Check the connection, then try again.",
    },
  },
  values: {
    title: "Values",
    joint: "Joint",
    commanded: "Commanded",
    measured: "Measured",
    error: "Following error",
    tip: "Plug tip",
    force: "Force",
    age: "Age",
    unit: "mm",
    unknown: "–",
    joints: { rho1: "ρ1", rho2: "ρ2", rho3: "ρ3" },
  },
  plots: {
    title: "Over time",
    loading: "Loading the plots…",
    joints: "Joints, mm",
    errors: "Following error, mm",
    force: "Force, N",
    forceWay: "Force over the way of ρ3, N",
    out: "out",
    back: "back",
    hold: "Hold still",
    go: "Go on",
  },
  /** In English the server's own sentences stand. */
  problems: null as BenchProblems | null,
  stop: {
    protective: "Stop",
    emergency: "Emergency stop",
    hint: "Stops every movement at once. While the robot moves, the space bar does the same.",
  },
};
