import { formatNumber } from "@/format";
import { say } from "../words";

interface Props {
  readonly title: string;
  readonly unit: "mm" | "px" | "N";
  /** Null where there was none. */
  readonly before: number | null;
  readonly after: number;
  readonly words?: readonly [before: string, after: string];
}

/** Two errors as bars under each other, with their numbers. */
export function BeforeAfter({ title, unit, before, after, words }: Props) {
  const [was, is] = words ?? [say.result.before, say.result.after];
  const most = Math.max(before ?? 0, after, 1e-6);
  const bars = [...(before === null ? [] : [[was, before, "calm"] as const]), [is, after, toneOf(before, after)] as const];
  return (
    <div class="bars">
      <h4>{title}</h4>
      <dl>
        {bars.map(([name, value, tone]) => (
          <div key={name} data-tone={tone}>
            <dt>{name}</dt>
            <dd>{`${formatNumber(value, value < 0.1 ? 3 : 2)} ${unit}`}</dd>
            <svg viewBox="0 0 100 4" preserveAspectRatio="none" aria-hidden="true">
              <rect width="100" height="4" class="bar-ground" />
              <rect width={Math.max((100 * value) / most, 0.75)} height="4" class="bar" />
            </svg>
          </div>
        ))}
      </dl>
    </div>
  );
}

const toneOf = (before: number | null, after: number): "good" | "problem" =>
  before !== null && after > before ? "problem" : "good";
