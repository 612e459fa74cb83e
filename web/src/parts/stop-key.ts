/** The space bar as a stop, also while a frame of this page has the keyboard. */
import { useEffect } from "preact/hooks";
import { pressStop } from "@/robot/actions";
import { description } from "@/robot/view";

const KEYS = [" ", "Escape"];

/**
 * Tells the page of the keys of a stop that were pressed inside a frame of the same origin.
 *
 * Keys go to the document that has the focus, and a click into the 3D view gives it to the frame:
 * without this a page would not hear of them. What the page does with a key, the frame does not do.
 * Call it each time that a document was loaded into the frame.
 */
export function hearStopKeys(frame: HTMLIFrameElement): void {
  // A frame that could not be loaded shows a page of the browser's own, which is not to be touched.
  if (frame.contentDocument === null) return;
  frame.contentWindow?.addEventListener(
    "keydown",
    (event) => {
      if (!KEYS.includes(event.key)) return;
      const { key, repeat } = event;
      const told = new KeyboardEvent("keydown", { key, repeat, cancelable: true });
      if (dispatchEvent(told)) return;
      event.preventDefault();
      event.stopPropagation();
    },
    { capture: true },
  );
}

/**
 * While something may move, the space bar stops it, unless it would press or write something:
 * a control that has the focus keeps its key.
 */
export function useStopKey(): void {
  useEffect(() => {
    const onKey = (event: KeyboardEvent): void => {
      const { target } = event;
      const onControl = target instanceof Element && target !== document.body;
      if (event.key !== " " || event.repeat || onControl) return;
      if (!description.peek().stoppable) return;
      event.preventDefault();
      pressStop("stop");
    };
    addEventListener("keydown", onKey);
    return () => removeEventListener("keydown", onKey);
  }, []);
}
