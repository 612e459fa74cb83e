import { useComputed } from "@preact/signals";
import { ControlNotice, ControlQuestion } from "@/control/notices";
import { GuidanceCard } from "@/guidance/card";
import { store } from "@/live/page";
import { ChoiceDialog, QuestionDialog } from "@/parts/dialogs";
import { GuideDialog } from "@/parts/guide";
import { Header } from "@/parts/header";
import { Hero } from "@/parts/hero";
import { History } from "@/parts/history";
import { Notices } from "@/parts/notices";
import { LanguagePicker } from "@/parts/language-picker";
import { PlanDialog } from "@/parts/plan";
import { Progress } from "@/parts/progress";
import { ReplayDialog } from "@/parts/replay";
import { RobotCard } from "@/parts/robot-card";
import { StationCard } from "@/parts/station-card";
import { StopBar } from "@/parts/stop-bar";
import { useStopKey } from "@/parts/stop-key";
import { useTitle } from "@/parts/title";
import { TwinAlarm } from "@/parts/twin-alarm";
import { Views } from "@/parts/views";

/** The home page. */
export function App() {
  useStopKey();
  useTitle();
  // Which cards there are is not known before: what would jump is not shown yet.
  const known = useComputed(() => store.live.value !== null || store.unreachable.value);
  return (
    <>
      <Header />
      <main class="page" data-known={known.value}>
        <div class="column">
          <GuidanceCard />
          <Hero />
          <ControlNotice />
          <TwinAlarm />
          <Notices />
          <StationCard />
        </div>
        <div class="column">
          <Progress />
          <Views />
          <History />
          <RobotCard />
          <LanguagePicker />
        </div>
      </main>
      <StopBar />
      <ControlQuestion />
      <GuideDialog />
      <QuestionDialog />
      <ChoiceDialog />
      <PlanDialog />
      <ReplayDialog />
    </>
  );
}
