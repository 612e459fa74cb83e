/** The panel as long as nobody has opened it: it is in the page's first file. */
import { computed } from "@preact/signals";
import { store } from "@/live/page";
import { later } from "@/technician/parts/later";
import { Panel } from "@/technician/parts/panel";
import { keep, kept } from "@/technician/parts/kept";
import { say } from "./words";

const OPEN_KEPT_AS = "plugpilot.calibration.open";

/** A routine is under way, or the panel was open before the page was loaded anew. */
const wanted = computed(() => {
  const state = store.live.value?.calibration?.routine?.state;
  return state === "running" || state === "interrupted" || kept("sessionStorage", OPEN_KEPT_AS) === "yes";
});

const Body = later(async () => (await import("./panel")).CalibrationBody);

/** Calibrations: what is in use, measuring, teaching, checking. */
export function CalibrationPanel() {
  const onToggled = (open: boolean): void => keep("sessionStorage", OPEN_KEPT_AS, open ? "yes" : "no");
  const hint = (store.live.value?.calibration?.hints ?? []).length > 0 ? say.wants : say.hint;
  return <Panel title={say.title} hint={hint} body={Body} wanted={wanted} onToggled={onToggled} />;
}
