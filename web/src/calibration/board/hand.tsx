import { Refusal, call } from "@/api/client";
import { trouble } from "../desk";
import { say } from "../words";
import { holdFor } from "./wish";
import type { Hold, Wish } from "./wish";

/** Whoever tries the simulator has no board: a simulated hand holds one. */
export function HandButtons({ wish }: { wish: Wish }) {
  const words = say.board.hand;
  return (
    <div class="board-hand" role="group" aria-label={words.title}>
      <p class="soft small">
        <strong>{words.title}.</strong> {words.tap}
      </p>
      <button type="button" class="button" onClick={() => void holdAt(holdFor(wish))}>
        {words.obey}
      </button>
      <button type="button" class="button" onClick={() => void tell({ type: "away" })}>
        {words.away}
      </button>
    </div>
  );
}

export const holdAt = (hold: Hold): Promise<void> => tell({ type: "hold", ...hold });

async function tell(command: unknown): Promise<void> {
  trouble.value = null;
  try {
    await call("/simulation/board", { method: "POST", body: command });
  } catch (error) {
    if (!(error instanceof Refusal)) throw error;
    trouble.value = error.trouble;
  }
}
