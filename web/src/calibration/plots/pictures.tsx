import { formatNumber } from "@/format";
import type { CameraEvidence } from "../types";
import { say } from "../words";
import { CoverageMap } from "./coverage";

const BAR = 16;
const HEIGHT = 120;
const ROOM = 18;

/** What a calibration of the camera rests on: the residual of each picture, and their coverage. */
export function Pictures({ evidence }: { evidence: CameraEvidence }) {
  const { views, coverage } = evidence;
  const most = Math.max(...views.map(({ rms_px }) => rms_px), 1e-6);
  const worst = Math.max(...views.filter(({ used }) => used).map(({ rms_px }) => rms_px), 0);
  const width = views.length * BAR;
  const level = HEIGHT - ((HEIGHT - ROOM) * evidence.rms_px) / most;
  return (
    <div class="pictures">
      <figure class="plot">
        <h4>{say.board.residuals}</h4>
        <svg
          viewBox={`0 0 ${String(width)} ${String(HEIGHT)}`}
          role="img"
          aria-label={say.board.residualsAlt(views.length, formatNumber(worst, 2))}
        >
          {views.map(({ rms_px, used }, number) => {
            const height = ((HEIGHT - ROOM) * rms_px) / most;
            return (
              <rect
                key={number}
                class={used ? "shot" : "shot outlier"}
                x={number * BAR + 3}
                y={HEIGHT - height}
                width={BAR - 6}
                height={height}
                rx="2"
              />
            );
          })}
          <line class="level" x1="0" x2={width} y1={level} y2={level} />
        </svg>
        <figcaption>
          <span class="key shot">{say.board.counts}</span>
          {views.some(({ used }) => !used) && <span class="key outlier">{say.board.leftOut}</span>}
          <span>{say.board.restsOn(views.filter(({ used }) => used).length, formatNumber(evidence.rms_px, 2))}</span>
        </figcaption>
      </figure>
      <CoverageMap counts={coverage} />
    </div>
  );
}
