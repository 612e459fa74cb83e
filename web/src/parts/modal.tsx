import { createContext } from "preact";
import type { ComponentChildren, FunctionComponent } from "preact";
import { useContext, useEffect, useId, useRef } from "preact/hooks";
import { StopBar } from "./stop-bar";

/**
 * The stop of this page. While a dialog is open nothing behind it can be pressed, so each dialog
 * has it too, at the same place.
 */
export const PageStop = createContext<FunctionComponent>(StopBar);

interface ModalProps {
  readonly title: string;
  /** As wide as the screen allows. */
  readonly wide?: boolean;
  readonly onClose: () => void;
  readonly children: ComponentChildren;
}

/** A native dialog over the page; Escape and a press beside it close it. */
export function Modal({ title, wide = false, onClose, children }: ModalProps) {
  const dialog = useRef<HTMLDialogElement>(null);
  const heading = useId();
  const Stop = useContext(PageStop);
  useEffect(() => {
    dialog.current?.showModal();
  }, []);
  return (
    <dialog
      ref={dialog}
      class={wide ? "modal wide" : "modal"}
      aria-labelledby={heading}
      onClose={onClose}
      onClick={(event) => {
        if (event.target === dialog.current) dialog.current?.close();
      }}
    >
      <div class="modal-body">
        <h2 id={heading}>{title}</h2>
        {children}
      </div>
      <Stop />
    </dialog>
  );
}
