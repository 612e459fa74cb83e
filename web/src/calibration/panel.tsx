import { useEffect } from "preact/hooks";
import { may } from "@/access/session";
import { TroubleNote } from "@/technician/parts/trouble";
import "./calibration.css";
import "./drift.css";
import "./question.css";
import "./plots/plots.css";
import { CheckView } from "./check";
import { close, edition, isUnderWay, loadLists, routine, trouble, unread, view } from "./desk";
import { Ended } from "./ended";
import { Guide } from "./guide";
import { Overview } from "./overview";
import { UnderWay } from "./under-way";
import { VersionView } from "./version";
import { say } from "./words";

/** What is under way comes first, then what somebody has opened, then how the last one ended. */
export function CalibrationBody() {
  const current = edition.value;
  useEffect(() => void loadLists(), [current]);
  return (
    <div class="calibration">
      {!may("service") && <p class="panel-note">{say.notAllowed}</p>}
      <Shown />
      <TroubleNote trouble={trouble.value} />
    </div>
  );
}

function Shown() {
  const now = routine.value;
  const opened = view.value;
  const running = now !== null && isUnderWay(now);
  useEffect(() => {
    if (running) close(); // the guide has done its work
  }, [running]);
  if (running) return <UnderWay routine={now} />;
  switch (opened.what) {
    case "guide":
      return <Guide key={opened.kind} kind={opened.kind} />;
    case "version":
      return <VersionView key={opened.id} id={opened.id} />;
    case "check":
      return <CheckView key={opened.id} id={opened.id} />;
    case "overview":
      return unread.value === null ? <Overview /> : <Ended routine={unread.value} />;
  }
}
