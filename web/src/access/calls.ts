/** Calls about access. */
import { call } from "@/api/client";
import type { components } from "@/api/schema";

type Schemas = components["schemas"];

export type Session = Schemas["AccessSession"];
export type Person = Schemas["PersonEntry"];
export type Invitation = Schemas["IssuedInvitation"];
export type OpenInvitation = Schemas["InvitationEntry"];
export type Key = Schemas["KeyEntry"];
export type IssuedKey = Schemas["IssuedKey"];
export type Passkey = Schemas["PasskeyEntry"];
export type TrailPage = Schemas["AuditPage"];
export type TrailEntry = Schemas["AuditRecord"];
export type Role = Schemas["Role"];
export type KeyScope = Schemas["Scope"];
export type Right = Schemas["Need"];

const ROOT = "/access";
const post = <Answer>(path: string, body?: unknown): Promise<Answer> =>
  call(ROOT + path, { method: "POST", body });
const remove = (path: string, id: string): Promise<unknown> =>
  call(`${ROOT}${path}/${encodeURIComponent(id)}`, { method: "DELETE" });

async function everyPage<Entry>(path: string): Promise<readonly Entry[]> {
  const entries: Entry[] = [];
  let cursor: string | null = null;
  do {
    const from: string = cursor === null ? "" : `?cursor=${cursor}`;
    const page: { items: readonly Entry[]; next_cursor: string | null } = await call(
      ROOT + path + from,
    );
    entries.push(...page.items);
    cursor = page.next_cursor;
  } while (cursor !== null);
  return entries;
}

export const getSession = (): Promise<Session> => call(`${ROOT}/session`);
export const pairDevice = (secret: string): Promise<Session> => post("/pairing", { secret });
export const endSession = (): Promise<unknown> => call(`${ROOT}/session`, { method: "DELETE" });
export const inviteOwnDevice = (): Promise<Invitation> => post("/devices/invitation");
export const ownerInvitation = (): Promise<Invitation> => post("/owner-invitation");

export const listPeople = (): Promise<readonly Person[]> => everyPage("/people");
export const removePerson = (id: string): Promise<unknown> => remove("/people", id);
export const removeDevice = (id: string): Promise<unknown> => remove("/devices", id);

export const listInvitations = (): Promise<readonly OpenInvitation[]> =>
  everyPage("/invitations");
export const createInvitation = (
  name: string,
  role: Role,
  endsAt: string | null,
): Promise<Invitation> => post("/invitations", { name, role, ends_at: endsAt });
export const withdrawInvitation = (id: string): Promise<unknown> => remove("/invitations", id);

export const listKeys = (): Promise<readonly Key[]> => everyPage("/keys");
export const createKey = (name: string, scopes: readonly KeyScope[]): Promise<IssuedKey> =>
  post("/keys", { name, scopes });
export const revokeKey = (id: string): Promise<unknown> => remove("/keys", id);

export const listTrail = (security: boolean, cursor: string | null): Promise<TrailPage> => {
  const from = cursor === null ? "" : `&cursor=${cursor}`;
  return call(`${ROOT}/audit?limit=30&security=${String(security)}${from}`);
};
export const TRAIL_EXPORT = `/api/v1${ROOT}/audit/export`;

export const listPasskeys = (): Promise<readonly Passkey[]> => everyPage("/passkeys");
export const removePasskey = (id: string): Promise<unknown> => remove("/passkeys", id);

/** Whether this browser can make and show passkeys on this page. */
export const takesPasskeys = (): boolean =>
  typeof PublicKeyCredential === "function" &&
  typeof PublicKeyCredential.parseCreationOptionsFromJSON === "function";

/** Makes a passkey of whoever is paired. The browser asks; null when the person says no. */
export async function addPasskey(): Promise<Passkey | null> {
  const { options } = await post<{ options: Record<string, unknown> }>("/passkeys/options");
  const publicKey = PublicKeyCredential.parseCreationOptionsFromJSON(
    options as unknown as PublicKeyCredentialCreationOptionsJSON,
  );
  const made = await asked(() => navigator.credentials.create({ publicKey }));
  return made === null ? null : post("/passkeys", { credential: made.toJSON() as unknown });
}

/** Shows a passkey; null when the person says no. */
export async function logIn(): Promise<Session | null> {
  const { options } = await post<{ options: Record<string, unknown> }>("/login/options");
  const publicKey = PublicKeyCredential.parseRequestOptionsFromJSON(
    options as unknown as PublicKeyCredentialRequestOptionsJSON,
  );
  const shown = await asked(() => navigator.credentials.get({ publicKey }));
  return shown === null ? null : post("/login", { credential: shown.toJSON() as unknown });
}

async function asked(ask: () => Promise<Credential | null>): Promise<PublicKeyCredential | null> {
  try {
    return (await ask()) as PublicKeyCredential | null;
  } catch (error) {
    // The browser's word for "the person said no, or took too long", and for a passkey that is
    // there already.
    const names = ["NotAllowedError", "InvalidStateError", "AbortError"];
    if (error instanceof DOMException && names.includes(error.name)) return null;
    throw error;
  }
}
