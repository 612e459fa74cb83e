import { useSignal } from "@preact/signals";
import type { Signal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useId } from "preact/hooks";
import type { Vehicle } from "@/api/wire";
import { jobOf } from "@/jobs/plan";
import { store } from "@/live/page";
import { plan, planning } from "@/robot/actions";
import { words } from "@/words";
import { Modal } from "./modal";

const MOST_KWH = 200;

/** When to begin, when to be ready, and how much. */
export function PlanDialog() {
  const vehicles = planning.value;
  return vehicles === null ? null : <PlanForm vehicles={vehicles} />;
}

function PlanForm({ vehicles }: { vehicles: readonly Vehicle[] }) {
  const say = words.plan;
  const vehicle = useSignal(vehicles[0]!.id);
  const begin = useSignal<string | null>(null);
  const ready = useSignal<string | null>("07:00");
  const energy_kwh = useSignal<string | null>(null);
  const close = (): void => {
    planning.value = null;
  };
  const submit = (event: Event): void => {
    event.preventDefault();
    const entered = {
      vehicle_id: vehicle.value,
      begin: begin.value,
      ready: ready.value,
      energy_kwh: energy_kwh.value === null ? null : Number(energy_kwh.value),
    };
    const robot = store.live.value?.robot;
    plan(jobOf(entered, robot === undefined ? new Date() : new Date(robot.updated_at)));
  };
  return (
    <Modal title={say.title} onClose={close}>
      <form class="plan" onSubmit={submit}>
        {vehicles.length > 1 && (
          <label class="plan-row">
            <span>{say.car}</span>
            <select value={vehicle.value} onChange={(e) => (vehicle.value = e.currentTarget.value)}>
              {vehicles.map(({ id, name }) => (
                <option key={id} value={id}>
                  {name}
                </option>
              ))}
            </select>
          </label>
        )}
        <Either title={say.begin} open={say.now} given={say.at} value={begin} initial="22:00">
          <Time label={say.time.begin} value={begin} />
        </Either>
        <Either title={say.ready} open={say.open} given={say.by} value={ready} initial="07:00">
          <Time label={say.time.ready} value={ready} />
        </Either>
        <Either title={say.energy} open={say.full} given={say.some} value={energy_kwh} initial="20">
          <input
            type="number"
            inputMode="decimal"
            min="0.5"
            max={MOST_KWH}
            step="0.5"
            required
            aria-label={`${say.energy}, ${say.kilowattHours}`}
            value={energy_kwh.value ?? ""}
            onInput={(event) => (energy_kwh.value = event.currentTarget.value)}
          />
          <span aria-hidden="true">{say.kilowattHours}</span>
        </Either>
        <button type="submit" class="button big primary">
          {say.confirm}
        </button>
        <button type="button" class="button big" onClick={close}>
          {say.cancel}
        </button>
      </form>
    </Modal>
  );
}

interface EitherProps {
  readonly title: string;
  /** The choice without a value, and the one with it. */
  readonly open: string;
  readonly given: string;
  readonly value: Signal<string | null>;
  readonly initial: string;
  readonly children: ComponentChildren;
}

/** Leave it open, or give a value. */
function Either({ title, open, given, value, initial, children }: EitherProps) {
  const name = useId();
  return (
    <fieldset class="plan-row">
      <legend>{title}</legend>
      <label>
        <input
          type="radio"
          name={name}
          checked={value.value === null}
          onChange={() => (value.value = null)}
        />
        {open}
      </label>
      <label>
        <input
          type="radio"
          name={name}
          checked={value.value !== null}
          onChange={() => (value.value = initial)}
        />
        {given}
      </label>
      {/* There but unseen while it is open, so that nothing jumps. */}
      <span class="plan-value" data-open={value.value === null}>
        {value.value !== null && children}
      </span>
    </fieldset>
  );
}

function Time({ label, value }: { label: string; value: Signal<string | null> }) {
  return (
    <input
      type="time"
      required
      aria-label={label}
      value={value.value ?? ""}
      onInput={(event) => (value.value = event.currentTarget.value)}
    />
  );
}
