import { Refusal, commandSimulatedCar } from "@/api/client";
import type { CarCommand } from "@/api/wire";
import { trouble } from "@/robot/actions";
import { say } from "./words";

const STEP_MM = 50;
const LEAST_ASIDE_MM = 40;
const MOST_ASIDE_MM = 140;

/** No two arrivals are alike. */
function arrival(): CarCommand {
  const aside = LEAST_ASIDE_MM + Math.random() * (MOST_ASIDE_MM - LEAST_ASIDE_MM);
  return {
    type: "drive_in",
    from_mm: 2200,
    right_mm: Math.random() < 0.5 ? aside : -aside,
    heading_deg: 0,
    past_mm: -40 - 80 * Math.random(),
    aims_right_mm: 0,
  };
}

function tell(command: CarCommand): void {
  trouble.value = null;
  commandSimulatedCar(command).catch((error: unknown) => {
    if (!(error instanceof Refusal)) throw error;
    trouble.value = error.trouble;
  });
}

/** The pedals of the simulated car, for whoever wants to try the guidance. */
export function SimulatedCar() {
  const names = say.simulated;
  return (
    <div class="pedals" role="group" aria-label={names.title}>
      <p class="soft">{names.title}</p>
      <Pedal name={names.driveIn} order={arrival} />
      <Pedal name={names.brake} order={() => ({ type: "brake" })} />
      <Pedal name={names.leave} order={() => ({ type: "leave" })} />
      <Pedal name={names.forward} order={() => straightOn(STEP_MM)} />
      <Pedal name={names.back} order={() => straightOn(-STEP_MM)} />
    </div>
  );
}

function straightOn(forward_mm: number): CarCommand {
  return { type: "drive_on", forward_mm, steer_right_mm: null };
}

function Pedal({ name, order }: { name: string; order: () => CarCommand }) {
  return (
    <button type="button" class="button" onClick={() => tell(order())}>
      {name}
    </button>
  );
}
