/** What the driver of an arriving car reads and hears. */
import type { GuidanceStep } from "@/api/wire";
import type { Sentences } from "@/guidance/instruction";

const directions: Record<GuidanceStep["direction"], string> = {
  forward: "forward",
  back: "back",
  left: "to the left",
  right: "to the right",
  up: "too low",
  down: "too high",
};

/** English is what the server speaks. */
const sentences: Sentences | null = null as Sentences | null;

export const guidance = {
  title: "Parking guidance",
  show: "Show",
  hide: "Hide",
  directions,
  sentences,
  picture: "Seen from above: the robot, the places it can reach, and the car’s socket.",
  legendReach: "in reach",
  robot: "Robot",
  skew: (degrees: string, limit: string): string => `askew ${degrees}° of ${limit}°`,
  sigma: (mm: string): string => `socket known to ± ${mm} mm`,
  simulated: {
    title: "You drive the simulated car",
    driveIn: "Drive in",
    brake: "Brake",
    forward: "5 cm on",
    back: "5 cm back",
    leave: "Leave",
  },
};
