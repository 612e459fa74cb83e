import { useComputed } from "@preact/signals";
import type { ReadonlySignal } from "@preact/signals";
import type { Live } from "@/api/wire";
import { formatDuration, formatEnergy, formatForce, formatPower } from "@/format";
import { costOf } from "@/jobs/history";
import { store } from "@/live/page";
import { isActive, phaseElapsedS } from "@/robot/job";
import { timeLeft } from "@/robot/outlook";
import { words } from "@/words";

type Kind = "charging" | "inserting" | "offline" | null;

/** Which figures matter now. */
function kindOf({ job, robot, station }: Live): Kind {
  if (isActive(job) && job.phase === "inserting") return "inserting";
  if (!station.online && robot.plug === "inserted") return "offline";
  if (isActive(job) && (job.phase === "charging" || job.phase === "plugged")) return "charging";
  return robot.plug === "inserted" && station.power_w > 0 ? "charging" : null;
}

/** Power, energy and time while charging; force and time while plugging in. */
export function StationCard() {
  const kind = useComputed(() => (store.live.value === null ? null : kindOf(store.live.value)));
  if (kind.value === null) return null;
  if (kind.value === "offline") return <p class="card">{words.station.offline}</p>;
  const power = <Figure label={words.station.power} show={(l) => formatPower(l.station.power_w)} />;
  const force = (
    <Figure
      label={words.station.force}
      show={({ robot }) => (robot.measured === null ? "–" : formatForce(robot.measured.force_n))}
    />
  );
  const energy = (
    <Figure
      label={words.station.energy}
      show={(l) => formatEnergy(l.station.session_energy_wh)}
    />
  );
  const running = isActive(store.live.value?.job ?? null);
  const foretold = store.live.value !== null && timeLeft(store.live.value) !== "";
  const time = foretold ? (
    <Figure key="left" label={words.station.left} show={timeLeft} />
  ) : (
    <Figure
      key="elapsed"
      label={words.station.elapsed}
      show={(l) => formatDuration(phaseElapsedS(l))}
    />
  );
  const cost = (
    <Figure
      label={words.station.cost}
      show={({ job }) => (job === null ? "" : (costOf(job) ?? ""))}
    />
  );
  const priced = store.live.value?.job?.result.cost != null && running;
  return (
    <dl class="figures" data-stale={store.stale.value}>
      {kind.value === "charging" ? [power, energy] : force}
      {kind.value === "charging" && priced && cost}
      {running && time}
    </dl>
  );
}

function Figure({ label, show }: { label: string; show: (live: Live) => string }) {
  const text: ReadonlySignal<string> = useComputed(() =>
    store.live.value === null ? "" : show(store.live.value),
  );
  return (
    <div class="figure">
      <dt>{label}</dt>
      <dd>{text}</dd>
    </div>
  );
}
