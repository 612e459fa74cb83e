/** Sentences of the guidance that do not come from the server. */
import type { GuidanceStep } from "@/api/wire";

type Direction = GuidanceStep["direction"];

const directions: Record<Direction, string> = {
  forward: "forward",
  back: "back",
  left: "to the left",
  right: "to the right",
  up: "too low",
  down: "too high",
};

export const say = {
  title: "Parking guidance",
  show: "Show",
  hide: "Hide",
  directions,
  /** Big and apart from its number: the unit of "30 cm" and "1.2 m". */
  number: (cm: number): { value: string; unit: string } =>
    cm < 100 ? { value: String(cm), unit: "cm" } : { value: (cm / 100).toFixed(1), unit: "m" },
  picture: "Seen from above: the robot, the places it can reach, and the car’s socket.",
  legendReach: "in reach",
  robot: "Robot",
  speed: (mm_s: number): string => `${(mm_s / 10).toFixed(0)} cm/s`,
  skew: (deg: number, limit: number): string => `askew ${deg.toFixed(0)}° of ${String(limit)}°`,
  sigma: (mm: number): string => `socket known to ± ${mm < 10 ? mm.toFixed(1) : mm.toFixed(0)} mm`,
  simulated: {
    title: "You drive the simulated car",
    driveIn: "Drive in",
    brake: "Brake",
    forward: "5 cm on",
    back: "5 cm back",
    leave: "Leave",
  },
} as const;
