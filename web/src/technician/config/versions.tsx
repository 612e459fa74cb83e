import { useSignal } from "@preact/signals";
import type { ConfigurationVersion } from "@/api/wire";
import { formatDate } from "@/format";
import { textOf } from "./draft";
import { goBack, saving, versions } from "./editor";
import { say } from "./words";

/** What held before, and the way back; going back asks once more. */
export function Versions() {
  const asked = useSignal<number | null>(null);
  return (
    <section class="config-versions">
      <h3>{say.versions}</h3>
      <ol>
        {versions.value.map((version, place) => (
          <li key={version.number}>
            <div>
              <strong>{version.at === null ? say.start : formatDate(version.at)}</strong>{" "}
              <span class="soft">{place === 0 ? `${version.by} · ${say.now}` : version.by}</span>
              <p class="soft">{changesIn(version)}</p>
            </div>
            {place > 0 && (
              <button
                type="button"
                class="button"
                disabled={saving.value}
                onBlur={() => {
                  asked.value = null;
                }}
                onClick={() => {
                  if (asked.value === version.number) void goBack(version.number);
                  asked.value = asked.value === version.number ? null : version.number;
                }}
              >
                {asked.value === version.number ? say.sure : say.back}
              </button>
            )}
          </li>
        ))}
      </ol>
    </section>
  );
}

/** All changes of a version in a line. */
function changesIn({ changes }: ConfigurationVersion): string {
  const parts = Object.entries(changes).flatMap(([section, settings]) =>
    Object.entries(settings).map(([name, value]) => `${section}.${name} = ${textOf(value)}`),
  );
  return parts.length === 0 ? say.noChanges : parts.join(", ");
}
