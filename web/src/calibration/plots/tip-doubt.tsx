import { formatNumber } from "@/format";
import type { RobotEvidence } from "../types";
import { say } from "../words";

const SIZE = 120;
const REACH = 50;
const STEPS = [5, 2, 1] as const;

/** What the plug's tip may still miss, as two rings around where it should be. */
export function TipDoubt({ evidence: { tip_likely_mm, tip_at_most_mm } }: { evidence: RobotEvidence }) {
  if (tip_likely_mm == null) return null; // made before this was worked out
  const most = tip_at_most_mm ?? null;
  const widest = Math.max(tip_likely_mm, most ?? 0, 1e-3);
  const scale = REACH / widest;
  const line = roundBelow(widest);
  const short = (value: number): string => formatNumber(value, 2);
  const words = say.tip;
  const text = most === null ? words.likelyOnly(short(tip_likely_mm)) : words.text(short(tip_likely_mm), short(most));
  const middle = SIZE / 2;
  return (
    <figure class="plot tip">
      <h4>{words.title}</h4>
      <svg viewBox={`0 0 ${String(SIZE)} ${String(SIZE + 16)}`} aria-hidden="true">
        {most !== null && <circle class="most" cx={middle} cy={middle} r={most * scale} />}
        <circle class="likely" cx={middle} cy={middle} r={tip_likely_mm * scale} />
        <path class="cross" d={`M${String(middle - 6)} ${String(middle)}h12M${String(middle)} ${String(middle - 6)}v12`} />
        <path class="scale" d={`M${String(middle - (line * scale) / 2)} ${String(SIZE + 3)}v6h${String(line * scale)}v-6`} />
      </svg>
      <div>
        <p>{text}</p>
        <figcaption>
          <span class="key likely">{words.likely}</span>
          {most !== null && <span class="key most">{words.most}</span>}
          <span>{words.scale(formatNumber(line, line < 0.1 ? 2 : line < 1 ? 1 : 0))}</span>
        </figcaption>
      </div>
    </figure>
  );
}

/** The largest of 1, 2 and 5 times a power of ten that is no longer. */
function roundBelow(longest: number): number {
  const power = 10 ** Math.floor(Math.log10(longest));
  return power * (STEPS.find((step) => step * power <= longest) ?? 1);
}
