import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { Refusal, stopByRest } from "@/api/client";
import { told } from "@/language/problems";
import { Brand } from "@/parts/header";
import { LanguagePicker } from "@/parts/language-picker";
import { words } from "@/words";
import { logIn, ownerInvitation, takesPasskeys } from "./calls";
import type { Invitation } from "./calls";
import { attempt, doorTrouble, enter, may, secretIn, session, useInvitation } from "./session";
import { say } from "./words";

const RENEW_MS = 10 * 60_000;

/** How a browser that the robot does not know gets in. */
export function Pairing() {
  const screen = session.value?.screen ?? false;
  return (
    <>
      <header class="header">
        <Brand />
      </header>
      <main class="door">
        <section class="card door-card">
          {screen ? <OwnScreen /> : <Ways />}
          <DoorTrouble />
        </section>
        {may("stop") && <LocalStop />}
        <LanguagePicker />
      </main>
    </>
  );
}

export function DoorTrouble() {
  if (doorTrouble.value === null) return null;
  const { title, remedy } = told(doorTrouble.value);
  return (
    <div class="door-trouble" role="alert">
      <strong>{title}</strong>
      <p>{remedy}</p>
    </div>
  );
}

function Ways() {
  const address = useSignal("");
  const secret = secretIn(address.value.trim());
  return (
    <>
      <h1>{say.door.title}</h1>
      <p class="soft">{say.door.how}</p>
      <ul class="points">
        {say.door.ways.map((way) => (
          <li key={way}>{way}</li>
        ))}
      </ul>
      <form
        class="door-form"
        onSubmit={(event) => {
          event.preventDefault();
          if (secret !== null) void useInvitation(secret);
        }}
      >
        <label>
          {say.door.paste}
          <input
            type="text"
            inputMode="url"
            autocomplete="off"
            autocapitalize="off"
            spellcheck={false}
            value={address.value}
            onInput={(event) => {
              address.value = event.currentTarget.value;
            }}
          />
        </label>
        <button type="submit" class="button big primary" disabled={secret === null}>
          {say.door.use}
        </button>
      </form>
      {session.value?.passkeys === true && takesPasskeys() && (
        <button
          type="button"
          class="button big"
          onClick={() =>
            void attempt(async () => {
              const entered = await logIn();
              if (entered !== null) enter(entered);
            })
          }
        >
          {say.door.passkey}
        </button>
      )}
    </>
  );
}

/** The robot's own screen, as long as nobody owns the robot. */
export function OwnScreen() {
  const invitation = useSignal<Invitation | null>(null);
  useEffect(() => {
    const renew = (): void => {
      void attempt(async () => {
        invitation.value = await ownerInvitation();
      });
    };
    renew();
    const timer = setInterval(renew, RENEW_MS);
    return () => clearInterval(timer);
  }, []);
  return (
    <>
      <h1>{say.door.screenTitle}</h1>
      <p class="soft">{say.door.screenHow}</p>
      {invitation.value !== null && <Code invitation={invitation.value} />}
    </>
  );
}

/** An invitation as a picture, and what to do when nobody could open it. */
export function Code({ invitation }: { invitation: Invitation }) {
  return (
    <>
      <img class="qr" src={invitation.qr} alt={invitation.address} />
      {!invitation.reachable && <p class="soft">{say.door.unreachable}</p>}
    </>
  );
}

/** On the robot's own machine anybody may stop it. */
export function LocalStop() {
  const done = useSignal(false);
  const stop = (): void => {
    done.value = false;
    void attempt(async () => {
      try {
        await stopByRest("stop");
      } catch (error) {
        if (error instanceof Refusal && !error.answered) throw new Refusal(words.trouble.stopUnsure, false);
        throw error;
      }
      done.value = true;
    });
  };
  return (
    <section class="door-stop">
      <button
        type="button"
        class="stop"
        // Stops as soon as the finger touches, not when it lifts.
        onPointerDown={stop}
        onClick={(event) => {
          if (event.detail === 0) stop(); // from a keyboard or a screen reader
        }}
      >
        {say.door.stop}
      </button>
      {done.value && <p role="status">{say.door.stopped}</p>}
    </section>
  );
}
