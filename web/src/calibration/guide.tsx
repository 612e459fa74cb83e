import { useSignal } from "@preact/signals";
import { may } from "@/access/session";
import { store } from "@/live/page";
import { canAct } from "@/robot/view";
import { say as bench } from "@/technician/words";
import { begin, busy, close, vehicles } from "./desk";
import { Drawing } from "./drawings";
import { CameraSwitch } from "./picture";
import { formatShort, requestOf, textIn } from "./request";
import type { Typed, Wrong } from "./request";
import { ROUTINES } from "./routines";
import type { Description, Field } from "./routines";
import type { RoutineKind } from "./types";
import { say } from "./words";

/** What is to be prepared for a routine, what was measured for it, and its beginning. */
export function Guide({ kind }: { kind: RoutineKind }) {
  const description = ROUTINES[kind];
  const { name, purpose, prepare, start } = say.routines[kind];
  const typed = useSignal<Typed>({});
  const chosen = useSignal("");
  const cars = vehicles.value;
  const car = cars.find(({ id }) => id === chosen.value) ?? cars[0];
  const { body, wrong } = requestOf(kind, description, typed.value, car?.id ?? null);
  const hindrance = hindranceOf(description) ?? (description.needsLabel && car === undefined ? say.guide.noCar : null);
  return (
    <form
      class="calibration-guide"
      noValidate
      onSubmit={(event) => {
        event.preventDefault();
        if (hindrance === null && Object.keys(wrong).length === 0) void begin(body);
      }}
    >
      <header>
        <Drawing name={description.drawing} />
        <div>
          <h3>{name}</h3>
          <p class="soft">{purpose}</p>
        </div>
      </header>
      <h4>{say.guide.prepare}</h4>
      <ol class="calibration-steps">
        {prepare.map((each) => (
          <li key={each}>{each}</li>
        ))}
      </ol>
      {kind === "camera" && (
        <a class="button calibration-link" href="/api/v1/calibrations/board.pdf" download>
          {say.board.sheet}
        </a>
      )}
      {description.plugIn && (
        <a class="button calibration-link" href="#jog">
          {say.guide.jog}
        </a>
      )}
      <div class="calibration-fields">
        {description.needsLabel && cars.length > 1 && (
          <label class="field calibration-car">
            <span>{say.guide.car}</span>
            <select
              value={car?.id}
              onChange={(event) => {
                chosen.value = event.currentTarget.value;
              }}
            >
              {cars.map((each) => (
                <option key={each.id} value={each.id}>
                  {each.name}
                </option>
              ))}
            </select>
          </label>
        )}
        {description.fields.map((field) => (
          <FieldInput
            key={field.name}
            field={field}
            text={textIn(field, typed.value)}
            wrong={wrong}
            type={(text) => {
              typed.value = { ...typed.value, [field.name]: text };
            }}
          />
        ))}
      </div>
      {description.fieldHint !== undefined && <p class="soft small">{say.fieldHints[description.fieldHint]}</p>}
      {description.needsLabel && <CameraSwitch />}
      {hindrance !== null && (
        <p class="panel-note" role="status">
          {hindrance}
        </p>
      )}
      <div class="calibration-actions">
        <button
          type="submit"
          class="button primary"
          disabled={busy.value || hindrance !== null || Object.keys(wrong).length > 0}
        >
          {busy.value ? say.guide.starting : start}
        </button>
        <button type="button" class="button" onClick={close}>
          {say.guide.back}
        </button>
      </div>
    </form>
  );
}

interface FieldInputProps {
  readonly field: Field;
  readonly text: string;
  readonly wrong: Wrong;
  readonly type: (text: string) => void;
}

function FieldInput({ field, text, wrong, type }: FieldInputProps) {
  const { name, least, most } = field;
  const why = wrong[name];
  const words = why === "noNumber" ? say.guide.noNumber : say.guide.between(formatShort(least), formatShort(most));
  return (
    <label class="field">
      <span>{say.fields[name]}</span>
      <input
        type="text"
        inputMode={field.whole === true ? "numeric" : "decimal"}
        autoComplete="off"
        value={text}
        aria-invalid={why !== undefined}
        onInput={(event) => type(event.currentTarget.value)}
      />
      {why !== undefined && <small class="calibration-wrong">{words}</small>}
    </label>
  );
}

/** Why it cannot begin now; the server looks at the rest. */
function hindranceOf({ plugIn }: Description): string | null {
  const robot = store.live.value?.robot;
  if (!may("service")) return say.notAllowed;
  if (robot === undefined || !canAct.value) return bench.jog.notLive;
  const { mode, plug, control } = robot;
  if (mode === "moving") return bench.jog.busy;
  // A routine switches the drives on and finds the position by itself, unless the plug is in.
  if (mode !== "ready" && (plugIn || (mode !== "off" && mode !== "not_homed"))) return bench.jog.not[mode];
  if (control !== null) return bench.jog.controlled(control.name);
  return !plugIn && plug === "inserted" ? say.guide.plugIn : null;
}
