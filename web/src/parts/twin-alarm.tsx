import { useComputed } from "@preact/signals";
import type { Divergence } from "@/api/wire";
import { formatNumber } from "@/format";
import { store } from "@/live/page";
import { words } from "@/words";

/** What was measured, beside what a good robot would measure. */
function figuresOf({ quantity, measured, expected, unit }: Divergence): string {
  const digits = quantity === "force" ? 0 : quantity === "phase_time" ? 1 : 2;
  const withUnit = (value: number): string => `${formatNumber(value, digits)}\u00a0${unit}`;
  return words.twin.figures(withUnit(measured), withUnit(expected));
}

/** Says in words where the robot and the model beside it have parted. */
export function TwinAlarm() {
  const found = useComputed(() => store.live.value?.twin?.divergences ?? []).value;
  return (
    <div role="status" class="twin-alarm" data-on={found.length > 0}>
      {found.length > 0 && (
        <section class="card">
          <h2>{words.twin.title}</h2>
          <p>{words.twin.remedy}</p>
          <ul>
            {found.map((each) => (
              <li key={each.quantity}>
                <strong>{words.twin.found[each.quantity]}.</strong> {figuresOf(each)}
              </li>
            ))}
          </ul>
        </section>
      )}
    </div>
  );
}
