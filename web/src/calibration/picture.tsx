import { useSignal } from "@preact/signals";
import { Picture, sentenceOf, useCamera } from "@/technician/camera/picture";
import { TroubleNote } from "@/technician/parts/trouble";
import { say } from "./words";

/** The camera's picture; nothing is asked of the camera before somebody wants to see it. */
export function CameraSwitch() {
  const shown = useSignal(false);
  return (
    <div class="calibration-camera">
      <button
        type="button"
        class="button"
        aria-expanded={shown.value}
        onClick={() => {
          shown.value = !shown.value;
        }}
      >
        {shown.value ? say.picture.hide : say.picture.show}
      </button>
      {shown.value && <Camera />}
    </div>
  );
}

function Camera() {
  const { shown, trouble } = useCamera();
  const now = shown.value;
  return (
    <>
      <Picture shown={now} old={trouble.value !== null} />
      {now !== null && <p class="soft small">{sentenceOf(now.inspection)}</p>}
      <TroubleNote trouble={trouble.value} />
    </>
  );
}
