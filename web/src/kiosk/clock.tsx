import { useComputed, useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { formatTime } from "@/format";

const LOOK_MS = 1000;

/** The time of day by the screen's own clock. */
export function Clock() {
  const now = useSignal(Date.now());
  useEffect(() => {
    const timer = setInterval(() => {
      now.value = Date.now();
    }, LOOK_MS);
    return () => clearInterval(timer);
  }, []);
  const text = useComputed(() => formatTime(now.value));
  return <time class="clock">{text}</time>;
}
