import { Fragment } from "preact";
import { may } from "@/access/session";
import { formatDate, formatNumber } from "@/format";
import { busy, checks, hasOlder, inForce, loadOlder, open, rollBack, vehicles, versions } from "./desk";
import { WhatJobsShow } from "./drift";
import { Drawing } from "./drawings";
import { GROUPS, ROUTINES } from "./routines";
import type { AccuracyCheck, Calibration, RoutineKind } from "./types";
import { say } from "./words";

/** What is in use, what can be measured, and everything that was. */
export function Overview() {
  return (
    <>
      <WhatJobsShow />
      <InUse />
      <section>
        <h3>{say.begin}</h3>
        <p class="soft small">{say.order}</p>
        {Object.entries(GROUPS).map(([group, kinds]) => (
          <Fragment key={group}>
            <h4>{say.groups[group as keyof typeof GROUPS]}</h4>
            <ul class="calibration-starts">
              {kinds.map((kind) => (
                <Start key={kind} kind={kind} />
              ))}
            </ul>
          </Fragment>
        ))}
      </section>
      <Versions />
      <Checks />
    </>
  );
}

function InUse() {
  const now = inForce.value;
  const sockets = now?.sockets ?? [];
  return (
    <section>
      <h3>{say.inUse.title}</h3>
      <ul class="calibration-list">
        {(["robot", "camera"] as const).map((kind) => (
          <Counting key={kind} name={say.kinds[kind]} instead={say.inUse.configured[kind]} version={now?.[kind] ?? null} />
        ))}
        {sockets.length === 0 && (
          <Counting name={say.kinds.socket} instead={say.inUse.configured.socket} version={null} />
        )}
        {sockets.map((version) => (
          <Counting key={version.id} name={nameOf(version)} instead="" version={version} />
        ))}
        {(["switches", "play", "force"] as const).map((kind) => (
          <Counting key={kind} name={say.kinds[kind]} instead={say.unmeasured} version={now?.[kind] ?? null} />
        ))}
      </ul>
    </section>
  );
}

/** What counts of one kind, and the way back to what counted before. */
function Counting({ name, instead, version }: { name: string; instead: string; version: Calibration | null }) {
  return (
    <li>
      <div>
        <strong>{name}</strong>{" "}
        <span class="soft">{version === null ? instead : `${say.numbered(version.version)}, ${formatDate(version.made_at)}`}</span>
      </div>
      {version !== null && (
        <button
          type="button"
          class="button"
          disabled={busy.value || !may("service")}
          aria-label={say.inUse.backTo(name)}
          onClick={() => void rollBack(version)}
        >
          {say.inUse.back}
        </button>
      )}
    </li>
  );
}

function Start({ kind }: { kind: RoutineKind }) {
  const { name, purpose } = say.routines[kind];
  const { drawing, looks, lookTakes_s } = ROUTINES[kind];
  return (
    <li>
      <button type="button" class="button calibration-start" onClick={() => open({ what: "guide", kind })}>
        <Drawing name={drawing} />
        <span>
          <strong>{name}</strong>
          <small>{purpose}</small>
          <small>{say.about(Math.max(1, Math.round((looks * lookTakes_s) / 60)))}</small>
        </span>
      </button>
    </li>
  );
}

function Versions() {
  const found = versions.value;
  return (
    <section>
      <h3>{say.versions.title}</h3>
      {found === null && <p class="soft">{say.loading}</p>}
      {found?.length === 0 && <p class="soft">{say.versions.none}</p>}
      <ol class="calibration-list calibration-versions">
        {(found ?? []).map((version) => (
          <li key={version.id}>
            <button type="button" class="button" onClick={() => open({ what: "version", id: version.id })}>
              <span>
                <strong>{nameOf(version)}</strong> {say.numbered(version.version)}
                <small>{`${formatDate(version.made_at)} · ${version.made_by} · ${errorOf(version)}`}</small>
              </span>
              <Chips version={version} />
            </button>
          </li>
        ))}
      </ol>
      {hasOlder.value && (
        <button type="button" class="button" onClick={() => void loadOlder()}>
          {say.versions.older}
        </button>
      )}
    </section>
  );
}

/** The grade, and whether it counts. */
export function Chips({ version }: { version: Calibration }) {
  return (
    <span class="chips">
      {version.in_force && (
        <span class="chip" data-tone="busy">
          {say.inUse.chip}
        </span>
      )}
      <GradeChip grade={version.grade} />
    </span>
  );
}

const TONES = { good: "good", usable: "ask", bad: "problem" } as const;

/** What it is worth, in a word. */
export function GradeChip({ grade }: { grade: Calibration["grade"] }) {
  return (
    <span class="chip" data-tone={TONES[grade]}>
      {say.grades[grade]}
    </span>
  );
}

function Checks() {
  const found = checks.value;
  return (
    <section>
      <h3>{say.checks.title}</h3>
      {found?.length === 0 && <p class="soft">{say.checks.none}</p>}
      <ol class="calibration-list calibration-versions">
        {(found ?? []).map((check) => (
          <li key={check.id}>
            <button type="button" class="button" onClick={() => open({ what: "check", id: check.id })}>
              <span>
                <strong>{formatDate(check.made_at)}</strong> {check.made_by}
                <small>{inShort(check)}</small>
              </span>
              {check.verdict != null && <GradeChip grade={check.verdict} />}
            </button>
          </li>
        ))}
      </ol>
    </section>
  );
}

const inShort = ({ accuracy_mm, repeatability_mm, calibration_id }: AccuracyCheck): string =>
  `AP ${formatNumber(accuracy_mm, 2)} mm · RP ${formatNumber(repeatability_mm, 2)} mm · ` +
  (calibration_id === null ? say.checks.asDrawn : say.checks.withVersion);

/** What it is a calibration of; a socket by the name of its car. */
export function nameOf({ kind, values }: Calibration): string {
  if (values.kind !== "socket") return say.kinds[kind];
  const { vehicle_id } = values;
  return say.socketOf(vehicles.value.find(({ id }) => id === vehicle_id)?.name ?? vehicle_id);
}

const UNITS = { camera: "px", force: "N" } as const;

export const unitOf = ({ kind }: Pick<Calibration, "kind">): "mm" | "px" | "N" =>
  kind === "camera" || kind === "force" ? UNITS[kind] : "mm";

function errorOf(version: Calibration): string {
  if (version.error === null) return say.unmeasured;
  return say.misses(formatNumber(version.error, 3), unitOf(version));
}
