/** The settings in force, what was typed over them, and what that would change. */
import { signal } from "@preact/signals";
import { call, Refusal } from "@/api/client";
import type { Trouble } from "@/api/client";
import type {
  Configuration,
  ConfigurationCheck,
  ConfigurationField,
  ConfigurationFields,
  ConfigurationHistory,
  ConfigurationVersion,
} from "@/api/wire";
import { read } from "./draft";
import type { Draft } from "./draft";

const CHECK_AFTER_MS = 350;
const NOTHING: ConfigurationCheck = { troubles: [], differences: [] };

export const configuration = signal<Configuration | null>(null);
export const fields = signal<readonly ConfigurationField[]>([]);
export const versions = signal<readonly ConfigurationVersion[]>([]);
/** Outlives the panel and every loss of the connection. */
export const draft = signal<Draft>({});
/** What is wrong with the fields, by their key. */
export const troubles = signal<Readonly<Record<string, string>>>({});
export const differences = signal<ConfigurationCheck["differences"]>([]);
export const trouble = signal<Trouble | null>(null);
export const saving = signal(false);
export const saved = signal(false);

let etag = "";
let checking: ReturnType<typeof setTimeout> | undefined;
let asked = 0;

const hearVersion = (heard: string): void => {
  etag = heard;
};

/** Reads everything; what was typed stays. */
export const load = (): Promise<void> =>
  attempt(async () => {
    fields.value = (await call<ConfigurationFields>("/config/fields")).fields;
    configuration.value = await call<Configuration>("/config", { onVersion: hearVersion });
    versions.value = (await call<ConfigurationHistory>("/config/versions")).versions;
    await check();
  });

/** Somebody types. */
export function type(key: string, text: string): void {
  draft.value = { ...draft.value, [key]: text };
  saved.value = false;
  clearTimeout(checking);
  checking = setTimeout(() => void attempt(check), CHECK_AFTER_MS);
}

export function discard(): void {
  clearTimeout(checking);
  draft.value = {};
  troubles.value = {};
  differences.value = [];
  trouble.value = null;
}

/** Saves what was typed, unless somebody has changed the settings meanwhile. */
export function save(): Promise<void> {
  const { patch } = read(draft.value, fields.value);
  return change(() =>
    call<Configuration>("/config", {
      method: "PATCH",
      body: patch,
      headers: { "If-Match": etag },
      onVersion: hearVersion,
    }),
  );
}

export const goBack = (number: number): Promise<void> =>
  change(() =>
    call<Configuration>(`/config/versions/${String(number)}/restore`, {
      method: "POST",
      headers: { "If-Match": etag },
      onVersion: hearVersion,
    }),
  );

async function change(make: () => Promise<Configuration>): Promise<void> {
  clearTimeout(checking);
  saving.value = true;
  await attempt(async () => {
    try {
      configuration.value = await make();
      discard();
      saved.value = true;
      versions.value = (await call<ConfigurationHistory>("/config/versions")).versions;
    } catch (error) {
      // What is there now is shown; what was typed stays, to be compared and saved again.
      if (error instanceof Refusal && error.trouble.code === "precondition_failed") await load();
      throw error;
    }
  });
  saving.value = false;
}

/** Asks the server what is wrong with the fields, and what they would change. */
async function check(): Promise<void> {
  const turn = ++asked;
  const { patch, unreadable } = read(draft.value, fields.value);
  const touched = Object.keys(patch).length > 0;
  const found = touched ? await call<ConfigurationCheck>("/config/check", { method: "POST", body: patch }) : NOTHING;
  if (turn !== asked) return; // more was typed meanwhile
  const named = found.troubles.map(({ key, sentence }) => [key, sentence] as const);
  troubles.value = { ...Object.fromEntries(named), ...unreadable };
  differences.value = found.differences;
}

async function attempt(work: () => Promise<void>): Promise<void> {
  trouble.value = null;
  try {
    await work();
  } catch (error) {
    if (!(error instanceof Refusal)) throw error;
    trouble.value = error.trouble;
  }
}
