import { useSignal } from "@preact/signals";
import { formatDate } from "@/format";
import {
  createInvitation,
  listInvitations,
  listPeople,
  removeDevice,
  removePerson,
  withdrawInvitation,
} from "./calls";
import type { Invitation, OpenInvitation, Person, Role } from "./calls";
import { SureButton, useList } from "./menu";
import type { Run } from "./menu";
import { Code } from "./pairing";
import { session } from "./session";
import { say } from "./words";

const DAY_MS = 86_400_000;
const JUST_NOW_MS = 120_000;
const ROLES: readonly Role[] = ["resident", "viewer", "technician", "owner"];
const SPANS = { forever: null, day: 1, week: 7, month: 30 } as const;

type Span = keyof typeof SPANS;

/** Everybody who is paired, and invitations for more. */
export function People({ run }: { run: Run }) {
  const [people, reloadPeople] = useList(run, listPeople);
  const [invitations, reloadInvitations] = useList(run, listInvitations);
  const made = useSignal<Made | null>(null);
  const reload = async (): Promise<void> => {
    await Promise.all([reloadPeople(), reloadInvitations()]);
  };
  if (made.value !== null) {
    return (
      <Shown
        title={say.people.show(made.value.name)}
        invitation={made.value.invitation}
        onDone={() => {
          made.value = null;
          run(reload);
        }}
      />
    );
  }
  if (people.value === null) return <p class="soft">{say.loading}</p>;
  return (
    <>
      <ul class="entries">
        {people.value.map((person) => (
          <PersonRow key={person.id} person={person} run={run} reload={reload} />
        ))}
      </ul>
      {(invitations.value?.length ?? 0) > 0 && (
        <>
          <h3>{say.people.open}</h3>
          <ul class="entries">
            {invitations.value?.map((each) => (
              <InvitationRow key={each.id} invitation={each} run={run} reload={reload} />
            ))}
          </ul>
        </>
      )}
      <Invite
        run={run}
        onMade={(now) => {
          made.value = now;
        }}
      />
    </>
  );
}

interface Made {
  readonly name: string;
  readonly invitation: Invitation;
}

interface RowProps {
  readonly run: Run;
  readonly reload: () => Promise<void>;
}

function PersonRow({ person, run, reload }: RowProps & { person: Person }) {
  const { name, may } = say.roles[person.role];
  const self = person.id === session.value?.person?.id;
  const notes = [
    person.ends_at === null ? null : `${say.people.ends} ${formatDate(person.ends_at)}`,
    person.passkeys > 0 ? say.people.passkeys(person.passkeys) : null,
  ].filter((note) => note !== null);
  return (
    <li>
      <div class="entry">
        <div>
          <p class="entry-title">
            {person.name} <span class="badge">{name}</span>
          </p>
          <p class="soft">{[may, ...notes].join("; ")}</p>
        </div>
        {!self && (
          <SureButton
            label={say.people.remove}
            onSure={() =>
              run(async () => {
                await removePerson(person.id);
                await reload();
              })
            }
          />
        )}
      </div>
      <ul class="devices">
        {person.devices.length === 0 && <li class="soft">{say.people.noDevice}</li>}
        {person.devices.map((device) => {
          const here = device.id === session.value?.device_id;
          return (
            <li key={device.id} class="entry">
              <div>
                <p>{device.name}</p>
                <p class="soft">
                  {here ? say.people.thisDevice : lastUse(device.last_used_at)}, {device.last_from}
                </p>
              </div>
              {!here && (
                <SureButton
                  label={say.people.remove}
                  onSure={() =>
                    run(async () => {
                      await removeDevice(device.id);
                      await reload();
                    })
                  }
                />
              )}
            </li>
          );
        })}
      </ul>
    </li>
  );
}

function lastUse(at: string): string {
  const recent = Date.now() - Date.parse(at) < JUST_NOW_MS;
  return `${say.people.lastUsed} ${recent ? say.people.now : formatDate(at)}`;
}

function InvitationRow({ invitation, run, reload }: RowProps & { invitation: OpenInvitation }) {
  return (
    <li class="entry">
      <div>
        <p>
          {invitation.name} <span class="badge">{say.roles[invitation.role].name}</span>
        </p>
        <p class="soft">
          {say.people.ends} {formatDate(invitation.expires_at)}
        </p>
      </div>
      <button
        type="button"
        class="button"
        onClick={() =>
          run(async () => {
            await withdrawInvitation(invitation.id);
            await reload();
          })
        }
      >
        {say.people.withdraw}
      </button>
    </li>
  );
}

function Invite({ run, onMade }: { run: Run; onMade: (made: Made) => void }) {
  const open = useSignal(false);
  const name = useSignal("");
  const role = useSignal<Role>("resident");
  const span = useSignal<Span>("forever");
  if (!open.value) {
    return (
      <button
        type="button"
        class="button big primary"
        onClick={() => {
          open.value = true;
        }}
      >
        {say.people.invite}
      </button>
    );
  }
  return (
    <form
      class="door-form"
      onSubmit={(event) => {
        event.preventDefault();
        run(async () => {
          const days = SPANS[span.value];
          const endsAt = days === null ? null : new Date(Date.now() + days * DAY_MS).toISOString();
          const invitation = await createInvitation(name.value.trim(), role.value, endsAt);
          onMade({ name: name.value.trim(), invitation });
        });
      }}
    >
      <h3>{say.people.invite}</h3>
      <label>
        {say.people.name}
        <input
          required
          maxLength={60}
          autocomplete="off"
          value={name.value}
          onInput={(event) => {
            name.value = event.currentTarget.value;
          }}
        />
      </label>
      <label>
        {say.people.role}
        <select
          value={role.value}
          onChange={(event) => {
            role.value = event.currentTarget.value as Role;
            // A technician comes and goes.
            span.value = role.value === "technician" ? "day" : "forever";
          }}
        >
          {ROLES.map((each) => (
            <option key={each} value={each}>
              {say.roles[each].name}: {say.roles[each].may}
            </option>
          ))}
        </select>
      </label>
      <label>
        {say.people.until}
        <select
          value={span.value}
          onChange={(event) => {
            span.value = event.currentTarget.value as Span;
          }}
        >
          {(Object.keys(SPANS) as Span[]).map((each) => (
            <option key={each} value={each}>
              {say.people[each]}
            </option>
          ))}
        </select>
      </label>
      <button type="submit" class="button big primary" disabled={name.value.trim() === ""}>
        {say.people.make}
      </button>
    </form>
  );
}

/** An invitation to be scanned or sent; this is the only time it is seen. */
export function Shown({
  title,
  invitation,
  onDone,
}: {
  title: string;
  invitation: Invitation;
  onDone: () => void;
}) {
  const copied = useSignal(false);
  return (
    <section class="shown">
      <h3>{title}</h3>
      <Code invitation={invitation} />
      <p class="soft">{say.people.scan}</p>
      <p class="secret">{invitation.address}</p>
      <div class="shown-buttons">
        {"clipboard" in navigator && (
          <button
            type="button"
            class="button"
            onClick={() => {
              void navigator.clipboard.writeText(invitation.address).then(() => {
                copied.value = true;
              });
            }}
          >
            {copied.value ? say.people.copied : say.people.copy}
          </button>
        )}
        <button type="button" class="button" onClick={onDone}>
          {say.people.done}
        </button>
      </div>
    </section>
  );
}
