import { useSignal } from "@preact/signals";
import { formatDate } from "@/format";
import {
  addPasskey,
  endSession,
  getSession,
  inviteOwnDevice,
  listPasskeys,
  removePasskey,
  takesPasskeys,
} from "./calls";
import type { Invitation } from "./calls";
import { SureButton, useList } from "./menu";
import type { Run } from "./menu";
import { Notifications } from "./notifications";
import { Shown } from "./people";
import { enter, session } from "./session";
import { say } from "./words";

/** One's own devices and passkeys. */
export function Own({ run, onGone }: { run: Run; onGone: () => void }) {
  const [passkeys, reload] = useList(run, listPasskeys);
  const made = useSignal<Invitation | null>(null);
  const person = session.value?.person;
  const possible = session.value?.passkeys === true && takesPasskeys();
  if (made.value !== null) {
    return (
      <Shown
        title={say.own.another}
        invitation={made.value}
        onDone={() => {
          made.value = null;
        }}
      />
    );
  }
  return (
    <>
      {person != null && <p>{say.own.you(person.name, say.roles[person.role].name)}</p>}
      <button
        type="button"
        class="button big"
        onClick={() =>
          run(async () => {
            made.value = await inviteOwnDevice();
          })
        }
      >
        {say.own.another}
      </button>
      <Notifications run={run} />
      <p class="soft">{possible ? say.own.passkeyHint : say.own.passkeyNeeds}</p>
      <ul class="entries">
        {passkeys.value?.map((passkey) => (
          <li key={passkey.id} class="entry">
            <div>
              <p>{passkey.name}</p>
              <p class="soft">{formatDate(passkey.created_at)}</p>
            </div>
            <SureButton
              label={say.people.remove}
              onSure={() =>
                run(async () => {
                  await removePasskey(passkey.id);
                  await reload();
                })
              }
            />
          </li>
        ))}
      </ul>
      {possible && (
        <button
          type="button"
          class="button big"
          onClick={() =>
            run(async () => {
              await addPasskey();
              await reload();
            })
          }
        >
          {say.own.passkey}
        </button>
      )}
      <SureButton
        label={say.own.signOut}
        onSure={() =>
          run(async () => {
            await endSession();
            onGone();
            enter(await getSession());
          })
        }
      />
    </>
  );
}
