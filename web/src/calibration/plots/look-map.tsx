import type { Routine } from "../types";
import { say } from "../words";
import { planeAround } from "./plane";

/** The places from which the label was looked for; the newest is ringed. */
export function LookMap({ looks }: { looks: Routine["looks"] }) {
  const plane = planeAround(looks);
  const seen = looks.filter((look) => look.seen).length;
  return (
    <figure class="plot">
      <svg
        viewBox={`0 0 ${String(plane.width)} ${plane.height.toFixed(0)}`}
        role="img"
        aria-label={say.underWay.map(seen, looks.length - seen)}
      >
        {looks.map((look, number) => {
          const [x, y] = plane.at(look);
          const newest = number === looks.length - 1;
          return (
            <g key={number} class={look.seen ? "look" : "look missed"}>
              <circle cx={x} cy={y} r="4" />
              {newest && <circle class="ring" cx={x} cy={y} r="9" />}
            </g>
          );
        })}
      </svg>
      <figcaption>
        <span class="key look">{say.underWay.seen}</span>
        {seen < looks.length && <span class="key missed">{say.underWay.unseen}</span>}
      </figcaption>
    </figure>
  );
}
