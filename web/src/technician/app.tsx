import { CalibrationPanel } from "@/calibration/opening";
import { ControlNotice, ControlQuestion } from "@/control/notices";
import { QuestionDialog } from "@/parts/dialogs";
import { Header } from "@/parts/header";
import { Notices } from "@/parts/notices";
import { TwinAlarm } from "@/parts/twin-alarm";
import { CameraPanel } from "./camera/panel";
import { ConfigPanel } from "./config/panel";
import { ConsolePanel } from "./console/panel";
import { LinkPanel } from "./link/panel";
import { DiagnosticsPanel } from "./diagnostics/panel";
import { UpdatedLine } from "./diagnostics/updated-line";
import { JogPad } from "./jog/pad";
import { Plots } from "./readings/plots";
import { Values } from "./readings/values";
import { RobotBox } from "./robot";
import { Stops } from "./stop";
import { TargetPanel } from "./target/panel";
import { say } from "./words";

/** The technician's page: everything about the robot at one glance, stop always in reach. */
export function Technician() {
  return (
    <>
      <Header />
      <main class="bench">
        <h1 class="unseen">{say.title}</h1>
        <div class="column">
          <UpdatedLine />
          <ControlNotice />
          <RobotBox />
          <TwinAlarm />
          <Notices />
          <Values />
        </div>
        <div class="column">
          <JogPad />
          <CalibrationPanel />
          <TargetPanel />
          <LinkPanel />
          <ConsolePanel />
        </div>
        <div class="column">
          <Plots />
          <CameraPanel />
          <ConfigPanel />
          <DiagnosticsPanel />
        </div>
      </main>
      <Stops />
      <ControlQuestion />
      <QuestionDialog />
    </>
  );
}
