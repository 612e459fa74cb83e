import { useComputed, useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { may } from "@/access/session";
import type { Guidance, GuidanceStep } from "@/api/wire";
import { formatNumber } from "@/format";
import { store } from "@/live/page";
import { Announcer } from "./announcer";
import { Sign } from "./icons";
import { distanceParts, formatLimit, instructionOf } from "./instruction";
import { SimulatedCar } from "./simulated-car";
import { TopView } from "./top-view";
import { bigStep, iconOf, toneOf } from "./view";
import { say } from "./words";

/** Shows itself when a car arrives; at other times it is a line that can be opened. */
export function GuidanceCard() {
  const guidance = useComputed(() => store.live.value?.guidance ?? null).value;
  const simulated = useComputed(
    () => store.live.value?.service.simulated_parts.includes("camera") ?? false,
  ).value;
  const arriving = guidance?.arriving ?? false;
  const opened = useSignal(false);
  const hidden = useSignal(false);
  const card = useRef<HTMLElement>(null);
  useEffect(() => {
    if (!arriving) hidden.value = false;
    else if (isAway(card.current)) card.current?.scrollIntoView({ block: "start" });
  }, [arriving]);
  if (guidance === null) return null;
  const open = opened.value || (arriving && !hidden.value);
  const toggle = (): void => {
    opened.value = !open;
    hidden.value = open;
  };
  return (
    <section
      ref={card}
      class="card guidance"
      data-open={open}
      data-arriving={arriving}
      aria-label={say.title}
    >
      {open && <Shown guidance={guidance} />}
      {open && simulated && may("service") && <SimulatedCar />}
      <button type="button" class="button guidance-toggle" aria-expanded={open} onClick={toggle}>
        <span>{open ? say.hide : say.title}</span>
        {!open && <span class="soft">{say.show}</span>}
      </button>
    </section>
  );
}

/** Not where a driver would look. */
function isAway(card: HTMLElement | null): boolean {
  const top = card?.getBoundingClientRect().top ?? 0;
  return top < 0 || top > innerHeight / 2;
}

function Shown({ guidance }: { guidance: Guidance }) {
  const step = bigStep(guidance);
  const told = instructionOf(guidance);
  return (
    <div data-tone={toneOf(guidance)} data-stale={store.stale.value} data-state={guidance.state}>
      <div class="order">
        <Sign icon={iconOf(guidance)} />
        {step === null ? (
          <p class="order-word">{told.headline}</p>
        ) : (
          <BigStep step={step} />
        )}
      </div>
      {guidance.state !== "paused" && <TopView guidance={guidance} />}
      <div class="order-more">
        <p class="order-detail">{told.detail}</p>
        {told.remedy !== "" && <p class="order-remedy">{told.remedy}</p>}
        <Facts guidance={guidance} />
      </div>
      <Spoken guidance={guidance} />
    </div>
  );
}

function BigStep({ step: { shown_cm, direction } }: { step: GuidanceStep }) {
  const { value, unit } = distanceParts(shown_cm);
  return (
    <p class="order-number">
      <strong>{value}</strong>
      <span class="order-unit">{unit}</span>
      <span class="order-way">{say.directions[direction]}</span>
    </p>
  );
}

/** What is known besides: speed, skew, certainty. */
function Facts({ guidance }: { guidance: Guidance }) {
  const { car, max_skew_deg } = guidance;
  if (car === null) return null;
  const sigma_mm = Math.hypot(car.sigma_x_mm, car.sigma_z_mm);
  const speed = Math.hypot(car.velocity_x_mm_s, car.velocity_z_mm_s);
  return (
    <ul class="facts soft">
      {!car.still && <li>{`${formatNumber(speed / 10, 0)} cm/s`}</li>}
      {car.skew_sigma_deg < 2 && (
        <li>{say.skew(formatNumber(car.skew_deg, 0), formatLimit(max_skew_deg))}</li>
      )}
      <li>{say.sigma(formatNumber(sigma_mm, sigma_mm < 10 ? 1 : 0))}</li>
    </ul>
  );
}

/** For those who listen: not every centimetre, and never in the middle of a sentence. */
function Spoken({ guidance }: { guidance: Guidance }) {
  const announcer = useRef(new Announcer());
  return (
    <p class="unseen" aria-live="polite" aria-atomic="true">
      {announcer.current.next(guidance, instructionOf(guidance), performance.now())}
    </p>
  );
}
