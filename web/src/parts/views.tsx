import { useComputed, useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { store } from "@/live/page";
import { words } from "@/words";
import { hearStopKeys } from "./stop-key";

type View = "camera" | "twin";

const VIEWS: readonly View[] = ["camera", "twin"];
const ICONS: Record<View, string> = {
  camera: "M3 8.5h4l1.5-2.5h7L17 8.5h4V19H3zM12 17a3.5 3.5 0 1 0 0-7 3.5 3.5 0 0 0 0 7z",
  twin: "M12 3l8 4.5v9L12 21l-8-4.5v-9zM4 7.5l8 4.5 8-4.5M12 12v9",
};

/** The camera or the 3D view; neither is loaded before it is asked for. */
export function Views() {
  const open = useSignal<View | null>(null);
  const view = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (open.value !== null) view.current?.scrollIntoView({ block: "nearest" });
  }, [open.value]);
  return (
    <section class="card views">
      <h2>{words.views.title}</h2>
      <div
        class="switch views-switch"
        role="group"
        aria-label={words.views.title}
        data-open={open.value !== null}
      >
        {VIEWS.map((each) => (
          <button
            key={each}
            type="button"
            class="button"
            aria-pressed={open.value === each}
            onClick={() => {
              open.value = open.value === each ? null : each;
            }}
          >
            <svg viewBox="0 0 24 24" aria-hidden="true">
              <path d={ICONS[each]} />
            </svg>
            {words.views[each]}
            <span class="hint">{words.views[`${each}Hint`]}</span>
          </button>
        ))}
      </div>
      <div ref={view} class="view" data-open={open.value !== null}>
        {open.value === "camera" && <Camera />}
        {open.value === "twin" && <Twin />}
      </div>
    </section>
  );
}

/** The moving picture of the camera; the connection ends with the element. */
function Camera() {
  const online = useComputed(() => store.live.value?.service.camera_online ?? true);
  const failed = useSignal(false);
  const image = useRef<HTMLImageElement>(null);
  useEffect(() => {
    const { current } = image;
    // Taking the element away does not end an endless picture in every browser.
    return () => current?.removeAttribute("src");
  }, [failed.value, online.value]);
  if (!online.value || failed.value) {
    return (
      <div class="view-note" role="status">
        <p>{words.views.cameraOff}</p>
        {failed.value && (
          <button
            type="button"
            class="button"
            onClick={() => {
              failed.value = false;
            }}
          >
            {words.views.retry}
          </button>
        )}
      </div>
    );
  }
  return (
    <>
      <p class="view-note">{words.views.loading}</p>
      <img
        ref={image}
        src="/api/v1/camera/stream.mjpg"
        alt={words.views.cameraAlt}
        onError={() => {
          failed.value = true;
        }}
      />
    </>
  );
}

/** The 3D view says by itself whether it still follows the robot. */
function Twin() {
  const frame = useRef<HTMLIFrameElement>(null);
  const behind = useSignal(false);
  useEffect(() => {
    const listen = (event: MessageEvent<unknown>): void => {
      if (event.origin !== location.origin) return;
      if (event.source !== frame.current?.contentWindow) return;
      const { data } = event;
      if (typeof data !== "object" || data === null || !("twin" in data)) return;
      behind.value = data.twin === "stale";
    };
    addEventListener("message", listen);
    return () => removeEventListener("message", listen);
  }, []);
  return (
    <>
      <p class="view-note">{words.views.loading}</p>
      <iframe
        ref={frame}
        src="/twin/"
        title={words.views.twin}
        data-behind={behind.value}
        onLoad={(event) => hearStopKeys(event.currentTarget)}
      />
      {behind.value && (
        <p class="view-warning" role="status">
          {words.views.twinFailed}
        </p>
      )}
    </>
  );
}
