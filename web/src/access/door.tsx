/** What stands in front of every page: nothing for those who are paired. */
import { signal } from "@preact/signals";
import type { FunctionComponent } from "preact";
import { useEffect } from "preact/hooks";
import { Refusal } from "@/api/client";
import { late } from "@/api/late";
import { speaking } from "@/language/catalogue";
import { Brand } from "@/parts/header";
import { Modal } from "@/parts/modal";
import { Picture } from "@/parts/picture";
import { trouble } from "@/robot/actions";
import { words } from "@/words";
import { Pairing } from "./pairing";
import { menuOpen, session, unanswered, useInvitation, waitingInvitation } from "./session";
import { say } from "./words";

const Menu = signal<FunctionComponent<{ onClose: () => void }> | null>(null);

interface DoorProps {
  readonly page: FunctionComponent;
  /** What those see whom the robot does not know. */
  readonly stranger?: FunctionComponent;
}

/** A page for those who are paired, the way in for all others. */
export function Door({ page: Page, stranger: Stranger = Pairing }: DoorProps) {
  const who = session.value;
  if (!speaking.value) return null;
  if (who === null) {
    return unanswered.value ? <Away /> : <p class="door-wait soft">{say.door.opening}</p>;
  }
  if (!who.paired) return <Stranger />;
  return (
    <>
      <Page />
      {menuOpen.value && <LoadedMenu />}
      {waitingInvitation.value !== null && <Replace secret={waitingInvitation.value} />}
    </>
  );
}

/** The page was opened without its robot. It goes on by itself as soon as the robot answers. */
function Away() {
  const { headline, detail } = words.state.unreachable;
  return (
    <>
      <header class="header">
        <Brand />
      </header>
      <main class="door away">
        <section class="hero" data-tone="problem">
          <Picture arm="parked" mark="asleep" tone="problem" />
          <div class="hero-text" role="status">
            <h1>{headline}</h1>
            <p>{detail}</p>
          </div>
        </section>
      </main>
    </>
  );
}

async function load(): Promise<void> {
  try {
    Menu.value = (await late(import("./menu"))).Menu;
  } catch (error) {
    if (!(error instanceof Refusal)) throw error;
    menuOpen.value = false;
    trouble.value = error.trouble;
  }
}

/** Loaded when it is opened for the first time: the home page stays small. */
function LoadedMenu() {
  useEffect(() => void load(), []);
  const Loaded = Menu.value;
  const close = (): void => {
    menuOpen.value = false;
  };
  return Loaded === null ? null : <Loaded onClose={close} />;
}

function Replace({ secret }: { secret: string }) {
  const close = (): void => {
    waitingInvitation.value = null;
  };
  return (
    <Modal
      title={say.door.replaceTitle(session.value?.person?.name ?? "")}
      onClose={close}
    >
      <p class="soft">{say.door.replace}</p>
      <button type="button" class="button big primary" onClick={() => void useInvitation(secret)}>
        {say.door.replaceYes}
      </button>
      <button type="button" class="button big" onClick={close}>
        {say.door.replaceNo}
      </button>
    </Modal>
  );
}
