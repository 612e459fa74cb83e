import type { BoardLook } from "../types";
import { holdFor, outlineOf } from "./wish";

/** The corners that were found, and dashed how the board is wanted next. */
export function BoardOverlay({ look }: { look: BoardLook }) {
  const { width_px, height_px, corners_px, outline_px, wish, notice } = look;
  const wanted = wish.place === null && wish.attitude === null ? null : outlineOf(holdFor(wish), width_px, height_px);
  return (
    <svg
      class="camera-overlay board-overlay"
      viewBox={`0 0 ${String(width_px)} ${String(height_px)}`}
      data-notice={notice}
      aria-hidden="true"
    >
      {wanted !== null && (
        <>
          <polygon class="halo" points={pointsOf(wanted)} />
          <polygon class="wanted" points={pointsOf(wanted)} />
        </>
      )}
      {outline_px.length > 2 && <polygon class="outline" points={pointsOf(outline_px)} />}
      {corners_px.map(([x, y], number) => (
        <circle key={number} cx={x} cy={y} r={width_px / 200} />
      ))}
    </svg>
  );
}

const pointsOf = (corners: readonly (readonly number[])[]): string =>
  corners.map((corner) => corner.map((each) => each.toFixed(1)).join(",")).join(" ");
