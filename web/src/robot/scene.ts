/** The picture of a state: wall, robot and car. */
import type { Job, Robot } from "@/api/wire";

/** How far the arm is out, and the mark beside it. */
export interface Scene {
  readonly arm: "parked" | "out" | "near" | "in";
  readonly mark: "none" | "search" | "bolt" | "alert" | "question" | "asleep" | "sync";
}

/** Where the plug is. */
export function armOf(robot: Robot): Scene["arm"] {
  switch (robot.plug) {
    case "parked":
      return "parked";
    case "free":
      return "out";
    case "inserted":
      return "in";
    case "unknown":
      return "near";
  }
}

/** What a running job does. */
export function sceneOf(job: Job, robot: Robot): Scene {
  switch (job.phase) {
    case "preflight":
      return { arm: armOf(robot), mark: "sync" };
    case "locating":
      return { arm: armOf(robot), mark: "search" };
    case "aligning":
      return { arm: "near", mark: "none" };
    case "inserting":
    case "plugged":
    case "releasing":
      return { arm: "in", mark: "none" };
    case "charging":
      return { arm: "in", mark: "bolt" };
    case "withdrawing":
      return { arm: "out", mark: "none" };
    case "parking":
      return { arm: "parked", mark: "none" };
  }
}
