import { useComputed } from "@preact/signals";
import { store } from "@/live/page";
import { words } from "@/words";

/** The name, the simulator's badge and the state of the connection. */
export function Header() {
  const service = useComputed(() => store.live.value?.service ?? null).value;
  const link = store.link.value;
  const quiet = link === "live" && store.stale.value;
  return (
    <header class="header">
      <span class="brand">
        <svg viewBox="0 0 32 32" aria-hidden="true">
          <rect width="32" height="32" rx="9" />
          <path d="M18 5 9 18h6l-1 9 9-13h-6z" />
        </svg>
        PlugPilot
      </span>
      {service?.simulated === true && (
        <span class="badge">{words.simulator(service.speed)}</span>
      )}
      <span class="link" data-link={quiet ? "quiet" : link} role="status">
        {quiet ? words.link.quiet : words.link[link]}
      </span>
    </header>
  );
}
