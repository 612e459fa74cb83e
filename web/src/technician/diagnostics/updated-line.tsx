import { useEffect } from "preact/hooks";
import { newsWanted, putAway, updatedTo, watchForFirstVisit } from "./updated";
import { say } from "./words";

/** Once after an update: a quiet line that leads to what is new, and can be put away. */
export function UpdatedLine() {
  useEffect(watchForFirstVisit, []);
  const version = updatedTo.value;
  if (version === null) return null;
  return (
    <p class="updated" role="status">
      <button
        type="button"
        class="button"
        onClick={() => {
          newsWanted.value = true;
          putAway();
        }}
      >
        {say.updated(version)}
      </button>
      <button type="button" class="button" aria-label={say.putAway} title={say.putAway} onClick={putAway}>
        ×
      </button>
    </p>
  );
}
