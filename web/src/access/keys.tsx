import { useSignal } from "@preact/signals";
import { formatDate } from "@/format";
import { createKey, listKeys, revokeKey } from "./calls";
import type { KeyScope } from "./calls";
import { SureButton, useList } from "./menu";
import type { Run } from "./menu";
import { say } from "./words";

/** Keys for programs. */
export function Keys({ run }: { run: Run }) {
  const [keys, reload] = useList(run, listKeys);
  const name = useSignal("");
  const chosen = useSignal<readonly KeyScope[]>(["read"]);
  const made = useSignal<string | null>(null);
  if (keys.value === null) return <p class="soft">{say.loading}</p>;
  return (
    <>
      <p class="soft">{say.keys.hint}</p>
      <ul class="entries">
        {keys.value.map((key) => (
          <li key={key.id} class="entry">
            <div>
              <p class="entry-title">
                {key.name} <span class="soft">…{key.hint}</span>
              </p>
              <p class="soft">
                {key.scopes.join(", ")};{" "}
                {key.last_used_at === null
                  ? say.keys.never
                  : `${say.people.lastUsed} ${formatDate(key.last_used_at)}, ${key.last_from ?? ""}`}
              </p>
            </div>
            <SureButton
              label={say.keys.revoke}
              onSure={() =>
                run(async () => {
                  await revokeKey(key.id);
                  await reload();
                })
              }
            />
          </li>
        ))}
      </ul>
      {made.value !== null && (
        <section class="shown">
          <p>{say.keys.once}</p>
          <p class="secret">{made.value}</p>
        </section>
      )}
      <form
        class="door-form"
        onSubmit={(event) => {
          event.preventDefault();
          run(async () => {
            made.value = (await createKey(name.value.trim(), chosen.value)).key;
            name.value = "";
            await reload();
          });
        }}
      >
        <label>
          {say.keys.name}
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
        <fieldset>
          {(Object.keys(say.scopes) as KeyScope[]).map((scope) => (
            <label key={scope} class="check">
              <input
                type="checkbox"
                checked={chosen.value.includes(scope)}
                onChange={(event) => {
                  const others = chosen.value.filter((each) => each !== scope);
                  chosen.value = event.currentTarget.checked ? [...others, scope] : others;
                }}
              />
              {say.scopes[scope]}
            </label>
          ))}
        </fieldset>
        <button
          type="submit"
          class="button big primary"
          disabled={name.value.trim() === "" || chosen.value.length === 0}
        >
          {say.keys.make}
        </button>
      </form>
    </>
  );
}
