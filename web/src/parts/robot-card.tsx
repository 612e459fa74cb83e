import { useSignal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { GiveBack } from "@/control/notices";
import { otherHolder, whoControls } from "@/control/state";
import { formatForce, formatNumber, formatPoint } from "@/format";
import { store } from "@/live/page";
import { command, pending, pressStop } from "@/robot/actions";
import { canAct } from "@/robot/view";
import { words } from "@/words";

/** Figures and switches that are seldom needed, closed until asked for. */
export function RobotCard() {
  const open = useSignal(false);
  return (
    <details
      class="card robot"
      onToggle={(event) => {
        open.value = event.currentTarget.open;
      }}
    >
      <summary>
        <h2>{words.robot.title}</h2>
      </summary>
      {open.value && <RobotFigures />}
    </details>
  );
}

function RobotFigures() {
  const live = store.live.value;
  if (live === null) return <p class="soft">{words.state.connecting.detail}</p>;
  const { robot, service } = live;
  const say = words.robot;
  const disabled = pending.value || !canAct.value || otherHolder.value !== null;
  const { measured, socket } = robot;
  return (
    <>
      <dl class="list" data-stale={store.stale.value || store.robotStale.value}>
        <Row label={say.mode}>{say.modes[robot.mode]}</Row>
        <Row label={say.plug}>{say.plugStates[robot.plug]}</Row>
        <Row label={say.drives}>{robot.enabled ? say.drivesOn : say.drivesOff}</Row>
        <Row label={say.tip}>
          {measured?.tip == null ? say.unknown : formatPoint(measured.tip)}
        </Row>
        <Row label={say.force}>
          {measured === null ? say.unknown : formatForce(measured.force_n)}
        </Row>
        <Row label={say.socket}>
          {socket === null ? say.unknown : `± ${formatNumber(socket.lateral_sigma_mm, 2)} mm`}
        </Row>
        <Row label={say.control}>{whoControls(live)}</Row>
        <Row label={say.driver}>{robot.driver}</Row>
        {service.simulated_parts.length > 0 && (
          <Row label={say.simulated}>
            {service.simulated_parts.map((part) => say.simulatedParts[part]).join(", ")}
          </Row>
        )}
        <Row label={say.version}>{service.version}</Row>
      </dl>
      <div class="switch">
        <button
          type="button"
          class="button"
          disabled={disabled}
          onClick={() => command(robot.enabled ? "disable" : "enable")}
        >
          {robot.enabled ? say.disable : say.enable}
        </button>
        <button
          type="button"
          class="button"
          disabled={disabled || !robot.enabled}
          onClick={() => command("home")}
        >
          {say.home}
        </button>
      </div>
      <GiveBack />
      <a class="button technician-link" href="/technician">
        {say.technician}
      </a>
      <button
        type="button"
        class="stop emergency"
        onClick={() => pressStop("emergency_stop")}
      >
        {words.action.emergency}
      </button>
    </>
  );
}

function Row({ label, children }: { label: string; children: ComponentChildren }) {
  return (
    <div>
      <dt>{label}</dt>
      <dd>{children}</dd>
    </div>
  );
}
