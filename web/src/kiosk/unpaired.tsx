import { DoorTrouble, LocalStop, OwnScreen, Pairing } from "@/access/pairing";
import { may, session } from "@/access/session";
import { say } from "@/access/words";
import { LanguagePicker } from "@/parts/language-picker";
import { Clock } from "./clock";

/** The robot's own screen before anybody has paired it: it stops the robot, for everybody. */
export function Unpaired() {
  // Elsewhere this is a browser like any other.
  if (!may("stop")) return <Pairing />;
  return (
    <>
      <header class="kiosk-bar">
        <LanguagePicker />
        <Clock />
      </header>
      <main class="kiosk-unpaired">
        <section class="card door-card">
          {session.value?.screen === true ? (
            <OwnScreen />
          ) : (
            <>
              <h1>{say.door.kioskTitle}</h1>
              <p class="soft">{say.door.kioskHow}</p>
            </>
          )}
          <DoorTrouble />
        </section>
        <LocalStop />
      </main>
    </>
  );
}
