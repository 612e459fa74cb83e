import { formatNumber } from "@/format";
import { drift, hints, open, vehicles } from "./desk";
import { hintOf } from "./hinted";
import type { Drift, Hint, RoutineKind } from "./types";
import { say } from "./words";

/** What jobs have shown: how far the belts have moved, and what wears. Nothing before they have. */
export function WhatJobsShow() {
  const belts = drift.value;
  const shown = belts !== null && belts.jobs > 0 ? belts : null;
  // What the figures say already is not said twice.
  const others = hints.value.filter(({ code }) => code !== "belts_drifted" || shown?.exceeds !== true);
  if (shown === null && others.length === 0) return null;
  return (
    <section class="calibration-drift">
      <h3>{say.drift.title}</h3>
      {shown !== null && <Belts belts={shown} />}
      {others.length > 0 && (
        <ul class="calibration-hints">
          {others.map((hint) => (
            <HintLine key={`${hint.code} ${hint.vehicle_id ?? ""}`} hint={hint} />
          ))}
        </ul>
      )}
    </section>
  );
}

function Belts({ belts }: { belts: Drift }) {
  const { moved_mm, proven_mm, exceeds, at_bound, jobs, left_percent, right_percent } = belts;
  const [moved, proven] = [moved_mm, proven_mm].map((each) => formatNumber(each, 2));
  const looser = Math.abs(left_percent) >= Math.abs(right_percent) ? "left" : "right";
  const most_mm = Math.max(2 * proven_mm, moved_mm);
  const anew = exceeds || at_bound;
  return (
    <div class="calibration-belts" data-tone={anew ? "ask" : "good"}>
      <p>{say.drift.moved(moved!, proven!)}</p>
      <div class="calibration-proven" style={{ "--proven": `${String((100 * proven_mm) / most_mm)}%` }}>
        <meter min={0} max={most_mm} value={moved_mm} aria-label={say.drift.title} />
      </div>
      <p class="soft small">
        {[
          `${say.drift.left} ${percent(left_percent, belts.left_sigma_percent)}`,
          `${say.drift.right} ${percent(right_percent, belts.right_sigma_percent)}`,
          say.drift.jobs(jobs),
        ].join(" · ")}
      </p>
      {anew && (
        <>
          <p>
            <strong>{exceeds ? say.drift.exceeds(looser) : say.drift.atBound}</strong>
          </p>
          <Mend kind="robot" />
        </>
      )}
    </div>
  );
}

function HintLine({ hint }: { hint: Hint }) {
  const { title, text, mendedBy } = hintOf(hint);
  const car = vehicles.value.find(({ id }) => id === hint.vehicle_id)?.name;
  return (
    <li>
      <p>
        <strong>{car === undefined || text.includes(car) ? title : `${title} (${car})`}.</strong> {text}
      </p>
      {mendedBy !== null && <Mend kind={mendedBy} />}
    </li>
  );
}

function Mend({ kind }: { kind: RoutineKind }) {
  return (
    <button type="button" class="button" onClick={() => open({ what: "guide", kind })}>
      {say.routines[kind].name}
    </button>
  );
}

const percent = (value: number, sigma: number): string =>
  `${value > 0 ? "+" : ""}${formatNumber(value, 2)} ± ${formatNumber(sigma, 2)} %`;
