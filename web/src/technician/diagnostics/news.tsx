import { useSignal, useSignalEffect } from "@preact/signals";
import { useRef } from "preact/hooks";
import type { Versions } from "@/api/wire";
import { language } from "@/language/language";
import { newsWanted } from "./updated";
import { say } from "./words";

/** What each release brought, the newest first. The notes themselves are written in English. */
export function News({ releases }: { releases: Versions["releases"] }) {
  const open = useSignal(false);
  const box = useRef<HTMLDetailsElement>(null);
  useSignalEffect(() => {
    if (!newsWanted.value) return;
    newsWanted.value = false;
    open.value = true;
    box.current?.scrollIntoView({ block: "start" });
    box.current?.querySelector("summary")?.focus({ preventScroll: true });
  });
  return (
    <details
      class="diagnostics-news"
      ref={box}
      open={open.value}
      onToggle={(event) => {
        open.value = event.currentTarget.open;
      }}
    >
      <summary>{say.news}</summary>
      {language.value !== "en" && <p class="soft">{say.newsInEnglish}</p>}
      {releases.map(({ version, released_on, changes }) => (
        <section key={version}>
          <h3>
            {version} <span class="soft">{released_on}</span>
          </h3>
          <ul lang="en">
            {changes.map((change) => (
              <li key={change}>{change}</li>
            ))}
          </ul>
        </section>
      ))}
    </details>
  );
}
