import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { may } from "@/access/session";
import { formatDate, formatDuration, formatNumber } from "@/format";
import { activate, busy, close, edition, open, putAway, readVersion, rollBack, trouble, unread } from "./desk";
import { Figures, Numbers } from "./numbers";
import { Chips, nameOf, unitOf } from "./overview";
import { BeforeAfter } from "./plots/before-after";
import { Pictures } from "./plots/pictures";
import { Residuals } from "./plots/residuals";
import { TipDoubt } from "./plots/tip-doubt";
import { Sentences } from "./sentences";
import { remarkOf, unseenOf } from "./translated";
import type { CalibrationDetail, Figure } from "./types";
import { say } from "./words";

interface Props {
  readonly id: string;
  /** Instead of the name of what was calibrated. */
  readonly title?: string;
  /** What the routine that has just ended has found. */
  readonly figures?: readonly Figure[];
  readonly onClose?: () => void;
}

/** One version: its verdict in words, before and after, what it rests on, and using it or not. */
export function VersionView({ id, title, figures = [], onClose = close }: Props) {
  const version = useSignal<CalibrationDetail | null>(null);
  const current = edition.value;
  useEffect(() => {
    void readVersion(id).then((found) => {
      if (found !== null) version.value = found;
    });
  }, [id, current]);
  const shown = version.value;
  return (
    <section class="calibration-version">
      {shown === null ? <p class="soft">{say.loading}</p> : <Version version={shown} title={title} figures={figures} />}
      <div class="calibration-actions">
        {shown !== null && <Use version={shown} />}
        <button type="button" class="button" onClick={onClose}>
          {closing(shown)}
        </button>
      </div>
    </section>
  );
}

/** What nobody uses yet is discarded; everything else is just closed. */
function closing(shown: CalibrationDetail | null): string {
  const fresh = unread.value?.calibration_id === shown?.id;
  return shown !== null && fresh && !shown.in_force ? say.result.discard : say.ended.close;
}

interface VersionProps {
  readonly version: CalibrationDetail;
  readonly title: string | undefined;
  readonly figures: readonly Figure[];
}

function Version({ version, title, figures }: VersionProps) {
  const { grade, in_force, error, error_in_use, made_by, made_at, remarks, evidence, camera_evidence, values, kind } = version;
  const unit = unitOf(version);
  return (
    <>
      <header>
        <h3>{title ?? `${nameOf(version)}, ${say.numbered(version.version)}`}</h3>
        <Chips version={version} />
      </header>
      <p>
        <strong>{say.result.verdicts[grade]}</strong> {in_force ? say.result.inUse : say.result.unused}
      </p>
      <Figures figures={figures} />
      {kind === "socket" && <Taught version={version} />}
      {kind !== "socket" && error !== null && error_in_use !== null && (
        <BeforeAfter title={say.result.compared[kind]} unit={unit} before={error_in_use} after={error} />
      )}
      <Sentences title={say.result.remarks} sentences={remarks.map(remarkOf)} />
      {evidence !== null && <TipDoubt evidence={evidence} />}
      {camera_evidence != null && <Pictures evidence={camera_evidence} />}
      {evidence !== null && values.kind === "robot" && <Residuals evidence={evidence} values={values} />}
      {evidence !== null && <Sentences title={say.result.unseen} sentences={evidence.unseen.map(unseenOf)} />}
      <Numbers version={version} folded={figures.length > 0} />
      <p class="soft small">
        {say.result.madeBy(made_by, formatDate(made_at))}
        {evidence !== null && ` · ${say.result.looks(evidence.looks.length, formatDuration(evidence.duration_s))}`}
      </p>
    </>
  );
}

/** A taught place is what others are measured by: what the one before missed, and whether it held still. */
function Taught({ version: { error, error_in_use } }: { version: CalibrationDetail }) {
  const lines = [
    [say.result.missedBefore, error_in_use],
    [say.result.moved, error],
  ] as const;
  return (
    <dl class="list">
      {lines.map(([name, value]) => (
        <div key={name}>
          <dt>{name}</dt>
          <dd>{value === null ? say.unmeasured : `${formatNumber(value, 2)} mm`}</dd>
        </div>
      ))}
    </dl>
  );
}

/** One tap puts it in use, or back; one that is worse is used only by who has read by how much. */
function Use({ version }: { version: CalibrationDetail }) {
  const disabled = busy.value || !may("service");
  if (version.in_force) {
    return (
      <button type="button" class="button" disabled={disabled} onClick={() => void rollBack(version)}>
        {say.inUse.back}
      </button>
    );
  }
  const warning = warningOf(version);
  return (
    <>
      {warning !== null && (
        <p class="calibration-worse" role="alert">
          {warning}
        </p>
      )}
      <button
        type="button"
        class={warning === null ? "button primary" : "button"}
        disabled={disabled}
        onClick={() => void use(version, warning !== null)}
      >
        {warning === null ? say.result.use : say.result.useAnyway}
      </button>
    </>
  );
}

async function use({ id }: CalibrationDetail, acceptWorse: boolean): Promise<void> {
  await activate(id, acceptWorse);
  if (trouble.value !== null || unread.value?.calibration_id !== id) return;
  putAway();
  open({ what: "version", id });
}

/** What speaks against it, with its numbers: as the server has just said, or as was measured. */
function warningOf(version: CalibrationDetail): string | null {
  const unit = unitOf(version);
  const refused = trouble.value?.code === "calibration_worse" ? trouble.value.context : undefined;
  const mine = numberOr(refused?.[`error_${unit}`], version.error);
  const other = numberOr(refused?.[`in_force_${unit}`], version.error_in_use);
  if (mine === null) return say.result.neverMeasured;
  if (other === null || mine <= other + (TIE[version.kind] ?? 0)) return null;
  const [a, b, more] = [mine, other, mine - other].map((each) => formatNumber(each, 3));
  return say.result.worse(a!, b!, more!, unit);
}

/** Differences that are chance, as the server takes them. */
const TIE: Partial<Record<CalibrationDetail["kind"], number>> = { camera: 0.01 };

const numberOr = (value: unknown, otherwise: number | null): number | null =>
  typeof value === "number" ? value : otherwise;
