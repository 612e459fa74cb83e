import { store } from "@/live/page";
import { command, pending, press, trouble } from "@/robot/actions";
import { canAct, description } from "@/robot/view";
import { words } from "@/words";
import { TroubleWords } from "./parts/trouble";
import { say } from "./words";

/** What the robot is doing, who has control, and its switches. */
export function RobotBox() {
  const robot = store.live.value?.robot;
  const { headline, detail, remedy, tone, action } = description.value;
  const disabled = pending.value || !canAct.value || robot === undefined;
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
          <dd>{robot?.control?.name ?? say.robot.nobody}</dd>
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
      {latched && (
        <button type="button" class="button big primary" disabled={disabled} onClick={() => press(action.kind)}>
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
