import { formatNumber } from "@/format";
import { say } from "../words";

const CELL = 40;
const GAP = 3;
/** So many corners in one cell are plenty. */
const PLENTY = 20;
const LEAST = 0.3;

/** Which parts of the picture the board has been in, as the camera sees it. */
export function CoverageMap({ counts }: { counts: readonly (readonly number[])[] }) {
  const cells = counts.flat();
  if (cells.length === 0) return null;
  const columns = counts[0]!.length;
  const share = formatNumber((100 * cells.filter((count) => count > 0).length) / cells.length, 0);
  return (
    <figure class="plot coverage">
      <h4>{say.board.coverage}</h4>
      <svg viewBox={`0 0 ${String(columns * CELL)} ${String(counts.length * CELL)}`} role="img" aria-label={say.board.covered(share)}>
        {cells.map((count, number) => (
          <rect
            key={number}
            class={count > 0 ? "cell" : "cell empty"}
            x={(number % columns) * CELL + GAP}
            y={Math.floor(number / columns) * CELL + GAP}
            width={CELL - 2 * GAP}
            height={CELL - 2 * GAP}
            rx="5"
            fill-opacity={count > 0 ? LEAST + (1 - LEAST) * Math.min(count / PLENTY, 1) : 0}
          />
        ))}
      </svg>
      <figcaption>{say.board.covered(share)}</figcaption>
    </figure>
  );
}
