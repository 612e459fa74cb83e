import { formatNumber } from "@/format";
import type { components } from "@/api/schema";
import { leftOver, platformAt } from "../mechanism";
import type { Place, RobotValues } from "../types";
import { say } from "../words";
import { enlargement, planeAround } from "./plane";

interface Arrow {
  readonly from: Place;
  readonly by: Place;
  readonly counts: boolean;
}

const ROOM = 30;
const HARDLY = 0.5;

/** What is left over at each place, as arrows that show the pattern: chance, or something bent. */
export function Residuals({ evidence, values }: { evidence: components["schemas"]["RobotEvidence"]; values: RobotValues }) {
  const arrows = evidence.looks.flatMap((look): Arrow[] => {
    const from = platformAt(values.mechanism, look);
    return from === null ? [] : [{ from, by: leftOver(look, values.camera_rotation_rad), counts: look.weight >= HARDLY }];
  });
  if (arrows.length === 0) return null;
  const plane = planeAround(arrows.map(({ from }) => from));
  const lengths = arrows.map(({ by }) => Math.hypot(by.x_mm, by.y_mm)).sort((a, b) => a - b);
  const times = enlargement(lengths.at(-1)!, ROOM / plane.scale);
  const middle = lengths[Math.floor(lengths.length / 2)]!;
  const words = say.residuals;
  return (
    <figure class="plot">
      <h4>{words.title}</h4>
      <svg
        viewBox={`0 0 ${String(plane.width)} ${plane.height.toFixed(0)}`}
        role="img"
        aria-label={words.alt(arrows.length, formatNumber(middle, 3), formatNumber(lengths.at(-1)!, 3))}
      >
        {arrows.map(({ from, by, counts }, number) => {
          const [x, y] = plane.at(from);
          const [toX, toY] = [x + by.x_mm * plane.scale * times, y - by.y_mm * plane.scale * times];
          return (
            <g key={number} class={counts ? "arrow" : "arrow outlier"}>
              <line x1={x} y1={y} x2={toX} y2={toY} />
              <circle cx={x} cy={y} r="2.5" />
            </g>
          );
        })}
      </svg>
      <figcaption>
        <span>{words.drawn(formatNumber(times, 0))}</span>
        {arrows.some(({ counts }) => !counts) && <span class="key outlier">{words.outlier}</span>}
      </figcaption>
    </figure>
  );
}
