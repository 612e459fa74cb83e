/** A gamepad as another hand: it moves only while its left shoulder button is held. */
import { deadMan, frame, press, step } from "./jog";
import { FRAMES } from "./axes";
import type { Way } from "./axes";

const DEAD_ZONE = 0.5;
const SHOULDER = 4;
/** Axes of the standard layout: left stick x and y, right stick y; up is negative. */
const STICKS = [
  { column: 0, axis: 0, sense: 1 },
  { column: 1, axis: 1, sense: -1 },
  { column: 2, axis: 3, sense: -1 },
] as const;

/** What a gamepad asks for; null while its dead-man button is up or no stick is pushed. */
export function wayOfGamepad(pad: Pick<Gamepad, "axes" | "buttons">): Way | null {
  if (pad.buttons[SHOULDER]?.pressed !== true) return null;
  const pushed = STICKS.map(({ column, axis, sense }) => ({
    column,
    value: sense * (pad.axes[axis] ?? 0),
  })).filter(({ value }) => Math.abs(value) > DEAD_ZONE);
  const [first, ...others] = pushed;
  // Two ways at once are nobody's intention.
  if (first === undefined || others.length > 0) return null;
  return { axis: FRAMES[frame.value][first.column]!, direction: first.value > 0 ? 1 : -1 };
}

/** Looks at the gamepads before every picture, as long as there is one. Returns how to end it. */
export function followGamepad(): () => void {
  let asked = 0;
  let mine: Way | null = null;
  const look = (): void => {
    const pad = navigator.getGamepads().find((each) => each !== null);
    const way = pad == null || step.value !== "hold" ? null : wayOfGamepad(pad);
    if (way !== null) press(way);
    else if (mine !== null) deadMan.release();
    mine = way;
    asked = pad == null ? 0 : requestAnimationFrame(look);
  };
  const begin = (): void => {
    if (asked === 0) asked = requestAnimationFrame(look);
  };
  addEventListener("gamepadconnected", begin);
  return () => {
    removeEventListener("gamepadconnected", begin);
    cancelAnimationFrame(asked);
  };
}
