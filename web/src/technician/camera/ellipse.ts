/** How large the uncertainty must be drawn to be seen. */
import type { CameraInspection } from "@/api/wire";

type SeenLabel = NonNullable<CameraInspection["label"]>;

/** A two-dimensional normal distribution lies with 95 % within so many standard deviations. */
export const SIGMAS_95 = 2.4477;

const MOST_OF_LABEL = 0.3;

/** Mean length of the sides of a label's outline [px]. */
export function side_px({ outline_px }: Pick<SeenLabel, "outline_px">): number {
  let length = 0;
  outline_px.forEach(([x, y], number) => {
    const [nextX, nextY] = outline_px[(number + 1) % outline_px.length]!;
    length += Math.hypot(nextX - x, nextY - y);
  });
  return length / 4;
}

/** The power of ten by which the 95 % ellipse fits well into the label; 1 if it is that large. */
export function magnification(major_px: number, side: number): number {
  if (!(major_px > 0 && side > 0)) return 1;
  const power = Math.floor(Math.log10((MOST_OF_LABEL * side) / (SIGMAS_95 * major_px)));
  return 10 ** Math.max(power, 0);
}
