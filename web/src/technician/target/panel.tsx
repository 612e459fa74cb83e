import { useSignal } from "@preact/signals";
import { useCallback, useEffect } from "preact/hooks";
import type { MoveTarget } from "@/api/wire";
import { formatNumber } from "@/format";
import { store } from "@/live/page";
import { releaseWithTheHand } from "../jog/dead-man";
import { hindrance, onlyOut, speed_mm_s } from "../jog/jog";
import { Panel } from "../parts/panel";
import { TroubleNote } from "../parts/trouble";
import { say as bench } from "../words";
import { TwinFrame } from "./frame";
import { placeAt } from "./sight";
import type { Sight } from "./sight";
import { arrived, beginsHere, choose, choosing, followTarget, forget, grip, hold, target, trouble } from "./target";
import { say } from "./words";

/** The 3D picture, and going to a place that somebody has pointed at in it. */
export function TargetPanel() {
  return <Panel title={say.title} hint={say.hint} body={Body} />;
}

function Body() {
  const note = useSignal("");
  useEffect(() => releaseWithTheHand(grip), []);
  useEffect(() => followTarget(), []);
  const onPick = useCallback((sight: Sight) => {
    const z_mm = store.live.peek()?.robot.commanded?.tip?.z_mm;
    if (hindrance.peek() !== null || z_mm === undefined || grip.held.peek() !== null) return;
    const place = placeAt(sight, z_mm);
    note.value = place === null ? say.beside : "";
    if (place !== null) void choose(place);
  }, []);
  const chosen = target.value;
  return (
    <>
      <TwinFrame onPick={onPick} />
      <div class="target-box">
        {chosen === null ? <Ask note={note.value} /> : <Preview chosen={chosen} />}
      </div>
      <TroubleNote trouble={trouble.value} />
    </>
  );
}

/** Why nothing can be chosen, or how to choose. */
function Ask({ note }: { note: string }) {
  const hindered = grip.held.value === null ? hindrance.value : null;
  const words = hindered ?? (onlyOut.value ? bench.jog.onlyOut : note || (arrived.value ? say.arrived : say.ask));
  return (
    <>
      <p class="panel-note" role="status">
        {words}
      </p>
      <PlaceForm disabled={hindered !== null || onlyOut.value || choosing.value} />
    </>
  );
}

/** The same without a pointer. */
function PlaceForm({ disabled }: { disabled: boolean }) {
  const x = useSignal("");
  const y = useSignal("");
  const wrong = useSignal(false);
  const submit = (event: Event): void => {
    event.preventDefault();
    const place = { x_mm: numberIn(x.value), y_mm: numberIn(y.value) };
    wrong.value = !Number.isFinite(place.x_mm) || !Number.isFinite(place.y_mm);
    if (!wrong.value) void choose(place);
  };
  return (
    <form class="target-form" aria-label={say.place} onSubmit={submit} noValidate>
      {([["x", x], ["y", y]] as const).map(([name, value]) => (
        <label key={name} class="field">
          <span>{say[name]}</span>
          <input
            type="text"
            inputMode="decimal"
            autoComplete="off"
            value={value.value}
            aria-invalid={wrong.value}
            onInput={(event) => {
              value.value = event.currentTarget.value;
            }}
          />
        </label>
      ))}
      <button type="submit" class="button" disabled={disabled}>
        {choosing.value ? say.showing : say.show}
      </button>
      {wrong.value && (
        <p class="target-wrong" role="alert">
          {say.notNumbers}
        </p>
      )}
    </form>
  );
}

/** A number with the decimal comma of the reader's country, or a point. */
const numberIn = (text: string): number => Number.parseFloat(text.replace(",", "."));

/** What would happen, and the one button that lets it happen. */
function Preview({ chosen }: { chosen: MoveTarget }) {
  const held = grip.held.value !== null;
  return (
    <>
      <h3>{say.preview(chosen.tip.x_mm, chosen.tip.y_mm)}</h3>
      <p class="soft">{say.checked}</p>
      <dl class="target-figures">
        <Figure name={say.way} value={`${formatNumber(chosen.distance_mm, 1)} mm`} />
        <Figure name={say.time} value={`${formatNumber(chosen.duration_s, 1)} s`} />
        <Figure name={say.speed} value={`${String(speed_mm_s.value)} mm/s`} />
      </dl>
      <Forces chosen={chosen} />
      <div class="target-actions">
        <HoldButton held={held} disabled={!held && (hindrance.value !== null || !beginsHere.value)} />
        <button type="button" class="button" onClick={() => void forget()}>
          {say.forget}
        </button>
      </div>
    </>
  );
}

function Figure({ name, value }: { name: string; value: string }) {
  return (
    <div>
      <dt>{name}</dt>
      <dd>{value}</dd>
    </div>
  );
}

function Forces({ chosen }: { chosen: MoveTarget }) {
  return (
    <div class="target-forces">
      <span class="soft">{say.force}</span>
      {chosen.forces.map(({ joint, force_n, limit_n, share }) => (
        <label key={joint}>
          <span>{say.joints[joint]}</span>
          <meter min={0} max={1} high={0.8} optimum={0} value={Math.min(share, 1)} />
          <span>{say.of(force_n, limit_n)}</span>
        </label>
      ))}
    </div>
  );
}

function HoldButton({ held, disabled }: { held: boolean; disabled: boolean }) {
  return (
    <button
      type="button"
      class="button primary target-hold"
      disabled={disabled}
      data-held={held}
      onPointerDown={(event) => {
        if (event.isPrimary && event.button === 0) hold();
        else grip.release();
      }}
      onPointerLeave={() => grip.release()}
      onContextMenu={(event) => event.preventDefault()}
      onKeyDown={(event) => {
        if (event.key !== "Enter") return;
        event.preventDefault();
        if (!event.repeat) hold();
      }}
      onKeyUp={() => grip.release()}
      onBlur={() => grip.release()}
    >
      {held ? say.moving : say.hold}
    </button>
  );
}
