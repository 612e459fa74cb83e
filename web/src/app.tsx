import { ChoiceDialog, QuestionDialog } from "@/parts/dialogs";
import { Header } from "@/parts/header";
import { Hero } from "@/parts/hero";
import { Progress } from "@/parts/progress";
import { RobotCard } from "@/parts/robot-card";
import { StationCard } from "@/parts/station-card";
import { StopBar } from "@/parts/stop-bar";
import { Views } from "@/parts/views";

/** The home page. */
export function App() {
  return (
    <>
      <Header />
      <main class="page">
        <div class="column">
          <Hero />
          <StationCard />
        </div>
        <div class="column">
          <Progress />
          <Views />
          <RobotCard />
        </div>
      </main>
      <StopBar />
      <QuestionDialog />
      <ChoiceDialog />
    </>
  );
}
