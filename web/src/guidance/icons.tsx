import type { Icon } from "./view";

const ARROW = "M24 5 41 24H30.5v19h-13V24H7z";
const TURNS: Partial<Record<Icon, number>> = { forward: 0, right: 90, back: 180, left: 270 };

/** One sign for each state, to be told apart by shape alone. */
export function Sign({ icon }: { icon: Icon }) {
  const turn = TURNS[icon];
  return (
    <svg class="sign" viewBox="0 0 48 48" aria-hidden="true" data-icon={icon}>
      {turn !== undefined ? (
        <path d={ARROW} transform={`rotate(${String(turn)} 24 24)`} />
      ) : (
        <Shape icon={icon} />
      )}
    </svg>
  );
}

function Shape({ icon }: { icon: Icon }) {
  switch (icon) {
    case "stop":
      return <path d="M15.5 4h17L44 15.5v17L32.5 44h-17L4 32.5v-17zM13 20v8h22v-8z" />;
    case "good":
      return <path d="M24 3a21 21 0 1 0 0 42 21 21 0 0 0 0-42zM20.5 34.5 11 25l3.5-3.5 6 6L33.5 14l3.5 3.5z" />;
    case "thin":
      return <path d="M24 3a21 21 0 1 0 0 42 21 21 0 0 0 0-42zM21 11h6l-1 17h-4zm0 21h6v6h-6z" />;
    case "askew":
      return <path d="M17 6.5 38.5 12a3 3 0 0 1 2 4l-7 24a3 3 0 0 1-4 2L9.5 36.5a3 3 0 0 1-2-4l6-24a3 3 0 0 1 3.5-2zM20 13l-2 7 14.5 4 2-7z" />;
    case "up":
    case "down":
      return <path d="M24 3 35 15h-7v18h7L24 45 13 33h7V15h-7z" />;
    case "alert":
      return <path d="M24 4 46 43H2zm-2.5 14v12h5V18zm0 15v5h5v-5z" />;
    case "closed":
      return <path d="M24 3a21 21 0 1 0 0 42 21 21 0 0 0 0-42zM10 20h28v8H10z" />;
    default:
      return <path d="M24 10C12 10 4.5 19.5 2 24c2.5 4.5 10 14 22 14s19.5-9.5 22-14c-2.5-4.5-10-14-22-14zm0 5a9 9 0 1 1 0 18 9 9 0 0 1 0-18zm0 5a4 4 0 1 0 0 8 4 4 0 0 0 0-8z" />;
  }
}
