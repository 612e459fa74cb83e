import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { may } from "@/access/session";
import { call, Refusal } from "@/api/client";
import type { Trouble } from "@/api/client";
import type { Versions } from "@/api/wire";
import { download } from "../parts/download";
import { Figures } from "../parts/figures";
import { Panel } from "../parts/panel";
import { TroubleNote } from "../parts/trouble";
import { fetchBundle } from "./bundle";
import { News } from "./news";
import { newsWanted } from "./updated";
import { say } from "./words";

/** One file for whoever helps from afar, and what runs here. */
export function DiagnosticsPanel() {
  return <Panel title={say.title} hint={say.hint} body={Diagnostics} wanted={newsWanted} />;
}

function Diagnostics() {
  const trouble = useSignal<Trouble | null>(null);
  const versions = useSignal<Versions | null>(null);
  const note = useSignal("");
  const busy = useSignal(false);
  const attempt = async (work: () => Promise<void>): Promise<void> => {
    trouble.value = null;
    try {
      await work();
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      trouble.value = error.trouble;
    }
  };
  useEffect(() => {
    void attempt(async () => {
      versions.value = await call<Versions>("/versions");
    });
  }, []);
  const collect = async (): Promise<void> => {
    busy.value = true;
    note.value = say.collecting;
    await attempt(async () => {
      const { content, name } = await fetchBundle();
      download(content, name);
      note.value = say.done(Math.ceil(content.size / 1024));
    });
    if (trouble.value !== null) note.value = "";
    busy.value = false;
  };
  const allowed = may("admin");
  return (
    <>
      <p class="soft">{say.explain}</p>
      <button type="button" class="button" disabled={busy.value || !allowed} onClick={() => void collect()}>
        {say.download}
      </button>
      <p class="soft diagnostics-note" role="status">
        {allowed ? note.value : say.notAllowed}
      </p>
      <TroubleNote trouble={trouble.value} />
      {versions.value === null ? (
        <p class="soft">{say.loading}</p>
      ) : (
        <>
          <News releases={versions.value.releases} />
          <VersionList versions={versions.value} />
        </>
      )}
    </>
  );
}

function VersionList({ versions }: { versions: Versions }) {
  const lines = [
    [say.software, versions.software],
    [say.board, versions.board ?? say.unknown],
    [say.firmware, versions.firmware ?? say.unknown],
    [say.protocol, versions.protocol_hash],
    [say.python, versions.python],
    [say.system, versions.system],
    ...versions.libraries.map(({ name, version }) => [name, version] as const),
  ] as const;
  return (
    <section class="diagnostics-versions">
      <Figures title={say.versions} lines={lines} />
    </section>
  );
}
