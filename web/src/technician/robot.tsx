import { GiveBack } from "@/control/notices";
import { otherHolder, whoControls } from "@/control/state";
import { store } from "@/live/page";
import { command, pending, press, trouble } from "@/robot/actions";
import { canAct, description } from "@/robot/view";
import { words } from "@/words";
import { TroubleWords } from "./parts/trouble";
import { say } from "./words";

/** What the robot is doing, who has control, and its switches. */
export function RobotBox() {
  const live = store.live.value;
  const robot = live?.robot;
  const { headline, detail, remedy, tone, action } = description.value;
  const idle = pending.value || !canAct.value || robot === undefined;
  const disabled = idle || otherHolder.value !== null;
  const latched = action?.kind === "reset" || action?.kind === "confirm_plug";
  const found = trouble.value;
  return (
    <section class="card robot-box" data-tone={tone}>
      <div class="robot-state" aria-live="polite">
        <h2>{headline}</h2>
        <p class="soft">{`${detail} ${remedy}`}</p>
      </div>
      <dl class="list">
        <div>
          <dt>{words.robot.mode}</dt>
          <dd>{robot === undefined ? words.robot.unknown : words.robot.modes[robot.mode]}</dd>
        </div>
        <div>
          <dt>{words.robot.plug}</dt>
          <dd>{robot === undefined ? words.robot.unknown : words.robot.plugStates[robot.plug]}</dd>
        </div>
        <div>
          <dt>{say.robot.control}</dt>
          <dd>{live === null ? words.robot.unknown : whoControls(live)}</dd>
        </div>
      </dl>
      <div class="switch">
        <button
          type="button"
          class="button"
          disabled={disabled}
          onClick={() => command(robot?.enabled === true ? "disable" : "enable")}
        >
          {robot?.enabled === true ? say.robot.disable : say.robot.enable}
        </button>
        <button
          type="button"
          class="button"
          disabled={disabled || robot?.enabled !== true}
          onClick={() => command("home")}
        >
          {say.robot.find}
        </button>
      </div>
      <GiveBack />
      {latched && (
        <button type="button" class="button big primary" disabled={idle} onClick={() => press(action.kind)}>
          {action.label}
        </button>
      )}
      <div role="alert">
        {found !== null && (
          <TroubleWords trouble={found} />
        )}
      </div>
    </section>
  );
}
