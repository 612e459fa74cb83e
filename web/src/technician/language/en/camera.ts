/** Every sentence of the camera's panel. */
import { formatNumber } from "@/format";
import type { CameraVerdict } from "../../camera/health";

/** The word, and what to do. */
const verdicts: Record<CameraVerdict, readonly [string, string]> = {
  asking: ["Waiting", "The first picture has not come yet."],
  slow: ["Slow", "Few pictures come. Is the computer busy, is the exposure long for want of light, or is the network slow?"],
  late: ["Late", "Pictures are old when they have been looked at. Is the computer busy, or is the network slow?"],
  good: ["Good", "Pictures come often and soon enough."],
};

export const camera = {
  title: "Camera",
  hint: "Label, pose, health",
  loading: "Waiting for the first picture…",
  alt: "Picture of the camera on the robot, now",
  nothing: "There is no readable label in the picture.",
  stranger: "This label belongs to no vehicle that is known here, so its size is unknown.",
  trusted: "The pose comes from all edges of the code and has passed every check.",
  coarse: "Only the corners fit: good to look at, nothing moves by it.",
  magnified: (times: number): string =>
    `Ellipses: where the centre is, 1 σ and 95 %, drawn ${formatNumber(times, 0)} times as large.`,
  inliers: (share: string, count: string): string => `${share} of ${count}`,
  pose: {
    title: "Pose in the camera frame",
    x: "Right",
    y: "Down",
    z: "Ahead",
    turnX: "Turn about x",
    turnY: "Turn about y",
    turnZ: "Turn about z",
    residual: "Residual",
    inliers: "Edges that fit",
    vehicle: "Vehicle",
  },
  health: {
    title: "Health",
    rate: "Frame rate",
    age: "Age when looked at",
    exposure: "Exposure",
    brightness: "Mean grey, 0 to 255",
    dark: "Without light",
    bright: "Clipped",
    rateOverTime: "Frame rate, Hz",
    ageOverTime: "Age when looked at, ms",
    verdicts,
  },
  unknown: "–",
};
