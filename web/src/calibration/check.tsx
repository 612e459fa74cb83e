import { formatDate, formatDuration, formatNumber } from "@/format";
import { busy, checks, close, downloadReport } from "./desk";
import { BeforeAfter } from "./plots/before-after";
import { NinePlaces } from "./plots/nine-places";
import { GradeChip } from "./overview";
import { Sentences } from "./sentences";
import { remarkOf } from "./translated";
import type { AccuracyCheck } from "./types";
import { say } from "./words";

interface Props {
  readonly id: string;
  readonly title?: string;
  readonly onClose?: () => void;
}

const FIGURES = [
  ["accuracy", "accuracy_mm"],
  ["repeatability", "repeatability_mm"],
  ["direction", "direction_variation_mm"],
] as const;

/** A nine-point check in the terms of ISO 9283, beside the one before. */
export function CheckView({ id, title, onClose = close }: Props) {
  const found = checks.value ?? [];
  const number = found.findIndex((each) => each.id === id);
  const check = found[number];
  return (
    <section class="calibration-check">
      {check === undefined ? (
        <p class="soft">{say.loading}</p>
      ) : (
        <Check check={check} before={found[number + 1]} title={title} />
      )}
      <div class="calibration-actions">
        {check !== undefined && (
          <button type="button" class="button" disabled={busy.value} onClick={() => void downloadReport(check)}>
            {say.checks.report}
          </button>
        )}
        <button type="button" class="button" onClick={onClose}>
          {say.ended.close}
        </button>
      </div>
    </section>
  );
}

interface CheckProps {
  readonly check: AccuracyCheck;
  readonly before: AccuracyCheck | undefined;
  readonly title: string | undefined;
}

function Check({ check, before, title }: CheckProps) {
  const { places, left_out, made_at, made_by, duration_s, calibration_id, verdict, remarks } = check;
  return (
    <>
      <header>
        <h3>{title ?? `${say.checks.title}, ${formatDate(made_at)}`}</h3>
        {verdict != null && <GradeChip grade={verdict} />}
      </header>
      {verdict != null && (
        <p>
          <strong>{say.checks.verdicts[verdict]}</strong>
        </p>
      )}
      <p>
        {say.checks.worst}: <strong>{`${formatNumber(check.accuracy_mm, 2)} mm`}</strong>,{" "}
        {calibration_id === null ? say.checks.asDrawn : say.checks.withVersion}.
      </p>
      <Sentences title={say.checks.mend} sentences={(remarks ?? []).map(remarkOf)} />
      {FIGURES.map(([name, key]) => (
        <BeforeAfter
          key={name}
          title={say.checks[name]}
          unit="mm"
          before={before?.[key] ?? null}
          after={check[key]}
          words={[say.checks.before, say.checks.now]}
        />
      ))}
      <NinePlaces places={places} />
      <p class="soft small">
        {`${say.checks.places(places.length, left_out)} · ${say.result.madeBy(made_by, formatDate(made_at))} · ${formatDuration(duration_s)}`}
      </p>
    </>
  );
}
