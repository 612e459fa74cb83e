import { useComputed, useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { may } from "@/access/session";
import type { Guidance } from "@/api/wire";
import { store } from "@/live/page";
import { Announcer } from "./announcer";
import { Sign } from "./icons";
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
  return (
    <div data-tone={toneOf(guidance)} data-stale={store.stale.value} data-state={guidance.state}>
      <div class="order">
        <Sign icon={iconOf(guidance)} />
        {step === null ? (
          <p class="order-word">{guidance.headline}</p>
        ) : (
          <p class="order-number">
            <strong>{say.number(step.shown_cm).value}</strong>
            <span class="order-unit">{say.number(step.shown_cm).unit}</span>
            <span class="order-way">{say.directions[step.direction]}</span>
          </p>
        )}
      </div>
      {guidance.state !== "paused" && <TopView guidance={guidance} />}
      <div class="order-more">
        <p class="order-detail">{guidance.detail}</p>
        {guidance.remedy !== "" && <p class="order-remedy">{guidance.remedy}</p>}
        <Facts guidance={guidance} />
      </div>
      <Spoken guidance={guidance} />
    </div>
  );
}

/** What is known besides: speed, skew, certainty. */
function Facts({ guidance }: { guidance: Guidance }) {
  const { car, max_skew_deg } = guidance;
  if (car === null) return null;
  const speed = Math.hypot(car.velocity_x_mm_s, car.velocity_z_mm_s);
  return (
    <ul class="facts soft">
      {!car.still && <li>{say.speed(speed)}</li>}
      {car.skew_sigma_deg < 2 && <li>{say.skew(car.skew_deg, max_skew_deg)}</li>}
      <li>{say.sigma(Math.hypot(car.sigma_x_mm, car.sigma_z_mm))}</li>
    </ul>
  );
}

/** For those who listen: not every centimetre, and never in the middle of a sentence. */
function Spoken({ guidance }: { guidance: Guidance }) {
  const announcer = useRef(new Announcer());
  return (
    <p class="unseen" aria-live="polite" aria-atomic="true">
      {announcer.current.next(guidance, performance.now())}
    </p>
  );
}
