import { ControlNotice, ControlQuestion } from "@/control/notices";
import { ChoiceDialog, QuestionDialog } from "@/parts/dialogs";
import { GuideDialog } from "@/parts/guide";
import { LinkState } from "@/parts/header";
import { Hero } from "@/parts/hero";
import { LanguagePicker } from "@/parts/language-picker";
import { Notices } from "@/parts/notices";
import { StationCard } from "@/parts/station-card";
import { StopBar } from "@/parts/stop-bar";
import { TimeLeft } from "@/parts/time-left";
import { TwinAlarm } from "@/parts/twin-alarm";
import { Clock } from "./clock";
import { Rest } from "./rest";

/** The robot's own touch screen: the state, what can be done about it, and the stop. */
export function Kiosk() {
  return (
    <>
      <header class="kiosk-bar">
        <LinkState />
        <LanguagePicker />
        <TimeLeft />
        <Clock />
      </header>
      <main class="kiosk-page">
        {/* Planning asks for numbers: that needs a keyboard, and is done on a phone. */}
        <Hero without="plan" />
        <div class="kiosk-notices">
          <ControlNotice />
          <TwinAlarm />
          <Notices />
        </div>
        <StationCard />
      </main>
      <StopBar />
      <ControlQuestion />
      <GuideDialog />
      <QuestionDialog />
      <ChoiceDialog />
      <Rest />
    </>
  );
}
