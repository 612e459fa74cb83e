import { formatNumber } from "@/format";
import type { CheckedPlace } from "../types";
import { say } from "../words";
import { enlargement, planeAround } from "./plane";

const ROOM = 30;

/** Where the robot came to at each place, from below and from above, much enlarged. */
export function NinePlaces({ places }: { places: readonly CheckedPlace[] }) {
  if (places.length === 0) return null;
  const plane = planeAround(places);
  const farthest = Math.max(...places.flatMap((place) => place.attained_mm.map(([x, y]) => Math.hypot(x - place.x_mm, y - place.y_mm))));
  const times = enlargement(farthest, ROOM / plane.scale);
  const worst = places.reduce((a, b) => (b.accuracy_mm > a.accuracy_mm ? b : a));
  const words = say.checks;
  const short = (value: number, digits: number): string => formatNumber(value, digits);
  return (
    <figure class="plot">
      <h4>{words.plot}</h4>
      <svg
        viewBox={`0 0 ${String(plane.width)} ${plane.height.toFixed(0)}`}
        role="img"
        aria-label={words.alt(short(worst.accuracy_mm, 2), short(worst.x_mm, 0), short(worst.y_mm, 0))}
      >
        {places.map((place) => {
          const [x, y] = plane.at(place);
          const reach = times * plane.scale;
          return (
            <g key={`${String(place.x_mm)} ${String(place.y_mm)}`}>
              <path class="cross" d={`M${String(x - 5)} ${String(y)}h10M${String(x)} ${String(y - 5)}v10`} />
              {place.attained_mm.map(([atX, atY], number) => (
                <circle
                  key={number}
                  class={number < place.attained_mm.length / 2 ? "below" : "above"}
                  cx={x + (atX - place.x_mm) * reach}
                  cy={y - (atY - place.y_mm) * reach}
                  r="2"
                />
              ))}
            </g>
          );
        })}
      </svg>
      <figcaption>
        <span>{words.drawn(short(times, 0))}</span>
        <span class="key below">{words.below}</span>
        <span class="key above">{words.above}</span>
      </figcaption>
    </figure>
  );
}
