import type { Trouble } from "@/api/client";
import { toldOnBench } from "../language/told";

/** What went wrong and what to do; a place for it is kept so that screen readers hear of it. */
export function TroubleNote({ trouble }: { trouble: Trouble | null }) {
  return <div role="alert">{trouble !== null && <TroubleWords trouble={trouble} />}</div>;
}

/** The same without being read out. */
export function TroubleWords({ trouble }: { trouble: Trouble }) {
  const { title, detail, remedy } = toldOnBench(trouble);
  return (
    <p class="panel-trouble">
      <strong>{title}.</strong> {detail} {remedy}
    </p>
  );
}
