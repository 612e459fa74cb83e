/** The title of the window: a tab that nobody looks at says when the robot asks. */
import { useSignalEffect } from "@preact/signals";
import { description } from "@/robot/view";

const NAME = "PlugPilot";

/** Follows the state for as long as the page is there. */
export function useTitle(): void {
  useSignalEffect(() => {
    const { headline, help } = description.value;
    document.title = help === null ? NAME : `● ${headline} · ${NAME}`;
  });
}
