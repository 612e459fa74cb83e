import type { Trouble } from "@/api/client";

/** What went wrong and what to do; a place for it is kept so that screen readers hear of it. */
export function TroubleNote({ trouble }: { trouble: Trouble | null }) {
  return (
    <div role="alert">
      {trouble !== null && (
        <p class="panel-trouble">
          <strong>{trouble.title}.</strong> {trouble.detail} {trouble.remedy}
        </p>
      )}
    </div>
  );
}
