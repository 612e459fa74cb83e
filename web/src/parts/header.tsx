import { useComputed } from "@preact/signals";
import { menuOpen } from "@/access/session";
import { say } from "@/access/words";
import type { Service } from "@/api/wire";
import { store } from "@/live/page";
import { words } from "@/words";

/** What is not real; camera and station together are the car as far as a robot can tell. */
function notReal({ simulated_parts: parts, speed }: Service): string | null {
  if (parts.includes("robot")) return words.simulator(speed);
  if (parts.length > 1) return words.simulated.car;
  if (parts.includes("camera")) return words.simulated.camera;
  return parts.includes("station") ? words.simulated.station : null;
}

/** The name, the simulator's badge, the state of the connection, and who may do what. */
export function Header() {
  const service = useComputed(() => store.live.value?.service ?? null).value;
  const badge = service === null ? null : notReal(service);
  return (
    <header class="header">
      <Brand />
      {badge !== null && <span class="badge">{badge}</span>}
      <LinkState />
      <button
        type="button"
        class="button menu-button"
        aria-label={say.menu}
        onClick={() => {
          menuOpen.value = true;
        }}
      >
        <svg viewBox="0 0 24 24" aria-hidden="true">
          <circle cx="12" cy="8.5" r="3.5" />
          <path d="M5 20c0-4 3-6 7-6s7 2 7 6" />
        </svg>
      </button>
    </header>
  );
}

/** Whether what the page shows is so now. */
export function LinkState() {
  const link = store.link.value;
  const quiet = link === "live" && store.stale.value;
  return (
    <span class="link" data-link={quiet ? "quiet" : link} role="status">
      {quiet ? words.link.quiet : words.link[link]}
    </span>
  );
}

/** The name and its sign. */
export function Brand() {
  return (
    <a class="brand" href="/" aria-label="PlugPilot">
      <svg viewBox="0 0 32 32" aria-hidden="true">
        <rect width="32" height="32" rx="9" />
        <path d="M18 5 9 18h6l-1 9 9-13h-6z" />
      </svg>
      <span>PlugPilot</span>
    </a>
  );
}
