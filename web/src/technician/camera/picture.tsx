import { useSignal } from "@preact/signals";
import type { ReadonlySignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import type { Trouble } from "@/api/client";
import type { CameraInspection } from "@/api/wire";
import { toldOnBench } from "../language/told";
import { magnification, side_px } from "./ellipse";
import { follow } from "./follow";
import type { Shown } from "./follow";
import { Overlay } from "./overlay";
import { say } from "./words";

interface Camera {
  readonly shown: ReadonlySignal<Shown | null>;
  readonly trouble: ReadonlySignal<Trouble | null>;
}

/** One inspection after the other, for as long as the component is there. */
export function useCamera(): Camera {
  const shown = useSignal<Shown | null>(null);
  const trouble = useSignal<Trouble | null>(null);
  useEffect(
    () =>
      follow({
        show: (next) => {
          trouble.value = null;
          shown.value = next;
        },
        fail: (why) => {
          trouble.value = why;
        },
      }),
    [],
  );
  return { shown, trouble };
}

/** The camera's picture with what is found in it. */
export function Picture({ shown, old }: { shown: Shown | null; old: boolean }) {
  if (shown === null) {
    return (
      <div class="camera-picture">
        <p class="view-note">{say.loading}</p>
      </div>
    );
  }
  const { width_px, height_px, label } = shown.inspection;
  return (
    <div class="camera-picture" data-old={old} style={{ aspectRatio: `${String(width_px)} / ${String(height_px)}` }}>
      <img src={shown.picture} alt={say.alt} />
      {label !== null && <Overlay width={width_px} height={height_px} label={label} />}
    </div>
  );
}

/** In a sentence or two: what there is to see, and how far it can be trusted. */
export function sentenceOf({ label, trouble }: CameraInspection): string {
  if (trouble !== null) {
    const coarse = label?.pose == null ? "" : ` ${say.coarse}`;
    const { title, detail, remedy } = toldOnBench(trouble);
    return `${title}. ${detail} ${remedy}${coarse}`;
  }
  if (label === null) return say.nothing;
  const { pose } = label;
  if (pose === null) return say.stranger;
  const times = magnification(pose.ellipse.major_px, side_px(label));
  return `${say.trusted} ${say.magnified(times)}`;
}
