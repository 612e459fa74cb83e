import { useComputed } from "@preact/signals";
import { store } from "@/live/page";
import { outlookInWords } from "@/robot/outlook";

/** When the running job is where people want it. Its line is kept free while nothing can be told. */
export function TimeLeft() {
  const text = useComputed(() => {
    const live = store.live.value;
    return live === null ? "" : outlookInWords(live);
  });
  return <p class="time-left">{text}</p>;
}
