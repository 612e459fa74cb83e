import { useEffect, useRef } from "preact/hooks";
import type { JogAxis } from "@/api/wire";
import { formatNumber } from "@/format";
import { toldOnBench } from "../language/told";
import { say } from "../words";
import { FRAMES, sameWay, wayOfKey } from "./axes";
import type { Direction, Frame, Way } from "./axes";
import { releaseWithTheHand } from "./dead-man";
import { followGamepad } from "./gamepad";
import { followReach, wayLeft_mm } from "./reach";
import {
  deadMan,
  frame,
  hindrance,
  isOpen,
  onlyOut,
  press,
  speed_mm_s,
  SPEEDS_MM_S,
  step,
  stepping,
  STEPS_MM,
  trouble,
} from "./jog";

/** Buttons that move the robot while they are held, or by steps. */
export function JogPad() {
  const box = useRef<HTMLElement>(null);
  useEffect(() => releaseWithTheHand(deadMan), []);
  useEffect(() => followGamepad(), []);
  useEffect(() => followReach(), []);
  const onKeyDown = (event: KeyboardEvent): void => {
    if (event.target instanceof HTMLInputElement || event.ctrlKey || event.metaKey || event.altKey) {
      return;
    }
    const way = wayOfKey(event.key, frame.value);
    if (way === null) return;
    event.preventDefault();
    if (!event.repeat) press(way);
  };
  return (
    <section
      ref={box}
      id="jog"
      class="card jog"
      tabIndex={0}
      aria-label={say.jog.title}
      data-held={deadMan.held.value !== null}
      onKeyDown={onKeyDown}
      onKeyUp={() => deadMan.release()}
      onBlur={() => deadMan.release()}
    >
      <h2>{say.jog.title}</h2>
      <div class="jog-layout">
        <div class="jog-choices">
          <Choices />
          <JogNote />
        </div>
        <div class="jog-pad" data-frame={frame.value}>
          {FRAMES[frame.value].map((axis) => (
            <AxisButtons key={axis} axis={axis} />
          ))}
        </div>
      </div>
      <p class="soft jog-help">
        {say.jog.keys} {say.jog.gamepad}
      </p>
    </section>
  );
}

function Choices() {
  return (
    <>
      <Choice
        label={say.jog.frame}
        options={Object.keys(FRAMES) as Frame[]}
        chosen={frame.value}
        show={(each) => say.jog.frames[each]}
        choose={(each) => {
          frame.value = each;
        }}
      />
      <Choice
        label={say.jog.amount}
        options={STEPS_MM}
        chosen={step.value}
        show={(each) => (each === "hold" ? say.jog.hold : formatNumber(each, each < 1 ? 1 : 0))}
        choose={(each) => {
          step.value = each;
        }}
      />
      <Choice
        label={say.jog.speed}
        options={SPEEDS_MM_S}
        chosen={speed_mm_s.value}
        show={String}
        choose={(each) => {
          speed_mm_s.value = each;
        }}
      />
    </>
  );
}

interface ChoiceProps<Option> {
  readonly label: string;
  readonly options: readonly Option[];
  readonly chosen: Option;
  readonly show: (option: Option) => string;
  readonly choose: (option: Option) => void;
}

/** One of a few, all of them to be seen. Changing it lets go of whatever is held. */
function Choice<Option extends string | number>(props: ChoiceProps<Option>) {
  const { label, options, chosen, show, choose } = props;
  return (
    <div class="choice" role="group" aria-label={label}>
      <span class="choice-label">{label}</span>
      <div class="choice-options">
        {options.map((each) => (
          <button
            key={each}
            type="button"
            class="button"
            aria-pressed={each === chosen}
            onClick={() => {
              deadMan.release();
              choose(each);
            }}
          >
            {show(each)}
          </button>
        ))}
      </div>
    </div>
  );
}

function AxisButtons({ axis }: { axis: JogAxis }) {
  return (
    <div class="jog-axis" data-axis={axis}>
      <JogButton way={{ axis, direction: 1 }} />
      <span class="jog-name">{say.jog.axes[axis]}</span>
      <JogButton way={{ axis, direction: -1 }} />
    </div>
  );
}

const ARROWS: Record<JogAxis, Record<Direction, string>> = {
  x: { 1: "M8 4l8 8-8 8", [-1]: "M16 4l-8 8 8 8" },
  y: { 1: "M4 16l8-8 8 8", [-1]: "M4 8l8 8 8-8" },
  insertion: { 1: "M4 12h12M11 6l6 6-6 6M20 5v14", [-1]: "M20 12H8M13 6l-6 6 6 6M4 5v14" },
  rho1: { 1: "M12 5v14M5 12h14", [-1]: "M5 12h14" },
  rho2: { 1: "M12 5v14M5 12h14", [-1]: "M5 12h14" },
  rho3: { 1: "M12 5v14M5 12h14", [-1]: "M5 12h14" },
};

function JogButton({ way }: { way: Way }) {
  const held = sameWay(deadMan.held.value, way);
  const left_mm = wayLeft_mm(way);
  const left = left_mm === null ? "" : say.jog.left(left_mm);
  const name = say.jog.ways[way.axis][way.direction];
  return (
    <button
      type="button"
      class="button jog-button"
      disabled={!held && (!isOpen(way) || stepping.value || left_mm === 0)}
      data-held={held}
      aria-label={left === "" ? name : `${name}, ${left}`}
      onPointerDown={(event) => {
        if (!event.isPrimary || event.button !== 0) {
          deadMan.release();
          return;
        }
        press(way);
      }}
      onPointerLeave={() => deadMan.release()}
      onContextMenu={(event) => event.preventDefault()}
      onClick={(event) => {
        // From a screen reader: a press cannot be held, so it is a step or nothing.
        if (event.detail === 0 && step.value !== "hold") press(way);
      }}
    >
      <svg viewBox="0 0 24 24" aria-hidden="true">
        <path d={ARROWS[way.axis][way.direction]} />
      </svg>
      <small>{left}</small>
    </button>
  );
}

/** Whether it can move, and why it did not. Always the same height. */
function JogNote() {
  const found = trouble.value;
  const ready = step.value === "hold" ? say.jog.ready : say.jog.readyStep;
  const told = found === null ? null : toldOnBench(found);
  const words = hindrance.value ?? (onlyOut.value ? say.jog.onlyOut : ready);
  return (
    <div class="jog-note" role="status" data-trouble={found !== null}>
      <p>{told === null ? words : `${told.title}. ${told.detail} ${told.remedy}`}</p>
    </div>
  );
}
