/** What stands in front of every page: nothing for those who are paired. */
import { signal } from "@preact/signals";
import type { FunctionComponent } from "preact";
import { useEffect } from "preact/hooks";
import { speaking } from "@/language/catalogue";
import { Modal } from "@/parts/modal";
import { Pairing } from "./pairing";
import { menuOpen, session, useInvitation, waitingInvitation } from "./session";
import { say } from "./words";

const Menu = signal<FunctionComponent<{ onClose: () => void }> | null>(null);

/** A page for those who are paired, the way in for all others. */
export function Door({ page: Page }: { page: FunctionComponent }) {
  const who = session.value;
  if (!speaking.value) return null;
  if (who === null) return <p class="door-wait soft">{say.door.opening}</p>;
  if (!who.paired) return <Pairing />;
  return (
    <>
      <Page />
      {menuOpen.value && <LoadedMenu />}
      {waitingInvitation.value !== null && <Replace secret={waitingInvitation.value} />}
    </>
  );
}

/** Loaded when it is opened for the first time: the home page stays small. */
function LoadedMenu() {
  useEffect(() => {
    void import("./menu").then((loaded) => {
      Menu.value = loaded.Menu;
    });
  }, []);
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
