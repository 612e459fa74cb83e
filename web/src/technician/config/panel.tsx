import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { may } from "@/access/session";
import type { Configuration, ConfigurationField } from "@/api/wire";
import { Panel } from "../parts/panel";
import { TroubleNote } from "../parts/trouble";
import { textOf, valueOf } from "./draft";
import {
  configuration,
  differences,
  discard,
  draft,
  fields,
  load,
  save,
  saved,
  saving,
  trouble,
  troubles,
  type,
} from "./editor";
import { Versions } from "./versions";
import { say } from "./words";

/** The settings: those that can be changed at once as a form, the others to be looked up. */
export function ConfigPanel() {
  return <Panel title={say.title} hint={say.hint} body={Config} />;
}

function Config() {
  const allowed = may("admin");
  useEffect(() => {
    if (allowed) void load();
  }, [allowed]);
  if (!allowed) return <p class="panel-note">{say.notAllowed}</p>;
  const now = configuration.value;
  return (
    <>
      {now === null && trouble.value === null && <p class="panel-note">{say.loading}</p>}
      {now !== null && <Form now={now} />}
      <TroubleNote trouble={trouble.value} />
      {now !== null && <Versions />}
      {now !== null && <InFile now={now} />}
    </>
  );
}

function Form({ now }: { now: Configuration }) {
  const changeable = fields.value.filter((field) => field.changeable);
  const wrong = Object.keys(troubles.value).length > 0;
  const touched = Object.keys(draft.value).length > 0;
  const general = troubles.value[""];
  return (
    <form
      class="config-form"
      noValidate
      onSubmit={(event) => {
        event.preventDefault();
        if (!wrong && differences.value.length > 0) void save();
      }}
    >
      <p class="soft">
        {say.atOnce} {say.empty}
      </p>
      {now.changeable.map((section) => (
        <fieldset key={section}>
          <legend lang="en">{section}</legend>
          {changeable
            .filter(({ key }) => key.startsWith(`${section}.`))
            .map((field) => (
              <SettingInput key={field.key} field={field} now={textOf(valueOf(now.settings, field.key))} />
            ))}
        </fieldset>
      ))}
      <Differences wrong={wrong} general={general} />
      <div class="switch">
        <button type="submit" class="button primary" disabled={wrong || saving.value || differences.value.length === 0}>
          {saving.value ? say.saving : say.save}
        </button>
        <button type="button" class="button" disabled={!touched} onClick={discard}>
          {say.discard}
        </button>
      </div>
    </form>
  );
}

function Differences({ wrong, general }: { wrong: boolean; general: string | undefined }) {
  const words = saved.value ? say.saved : say.none;
  return (
    <div class="config-differences" aria-live="polite">
      <h3>{say.differences}</h3>
      {wrong && <p class="config-wrong">{general ?? say.wrong}</p>}
      {!wrong && differences.value.length === 0 && <p class="soft">{words}</p>}
      <ul>
        {differences.value.map(({ key, before, after }) => (
          <li key={key}>
            <code>{key}</code> <del>{textOf(before) || say.nothing}</del> → <ins>{textOf(after) || say.nothing}</ins>
          </li>
        ))}
      </ul>
    </div>
  );
}

function SettingInput({ field, now }: { field: ConfigurationField; now: string }) {
  const { key, kind, words, choices, least, most } = field;
  const id = `setting-${key}`;
  const wrong = troubles.value[key];
  const described = {
    id,
    value: draft.value[key] ?? now,
    "aria-invalid": wrong !== undefined,
    "aria-describedby": `${id}-words`,
  };
  const options = kind === "boolean" ? ["true", "false"] : choices;
  return (
    <div class="field config-field">
      <label for={id} lang="en">{key.split(".").slice(1).join(".").replaceAll("_", " ")}</label>
      {options.length > 0 ? (
        <select {...described} onChange={(event) => type(key, event.currentTarget.value)}>
          {options.map((each) => (
            <option key={each} value={each}>
              {each}
            </option>
          ))}
        </select>
      ) : (
        <input
          {...described}
          type="text"
          inputMode={kind === "number" || kind === "integer" ? "decimal" : "text"}
          autoComplete="off"
          spellcheck={false}
          onInput={(event) => type(key, event.currentTarget.value)}
        />
      )}
      <p id={`${id}-words`} class={wrong === undefined ? "soft" : "config-wrong"}>
        {wrong ?? (
          <>
            <span lang="en">{words}.</span> {say.limits(least, most)}
          </>
        )}
      </p>
    </div>
  );
}

/** Everything else, to be looked up. */
function InFile({ now }: { now: Configuration }) {
  const search = useSignal("");
  const wanted = search.value.trim().toLowerCase();
  const fixed = fields.value.filter(({ changeable }) => !changeable);
  const shown = fixed.filter(({ key, words }) => `${key} ${words}`.toLowerCase().includes(wanted));
  return (
    <section class="config-file" aria-label={say.file}>
      <h3>{say.file}</h3>
      <p class="soft">{say.fileHint}</p>
      <label class="field">
        <span>{say.find}</span>
        <input
          type="search"
          value={search.value}
          autoComplete="off"
          onInput={(event) => {
            search.value = event.currentTarget.value;
          }}
        />
      </label>
      <div class="config-list" tabIndex={0} role="group" aria-label={say.file}>
        <dl lang="en">
          {shown.map(({ key, words }) => (
            <div key={key} title={words}>
              <dt>{key}</dt>
              <dd>{textOf(valueOf(now.settings, key)) || say.nothing}</dd>
            </div>
          ))}
        </dl>
      </div>
      <p class="soft">{say.count(shown.length, fixed.length)}</p>
    </section>
  );
}
