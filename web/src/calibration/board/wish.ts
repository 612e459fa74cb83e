/** What is asked of whoever holds the board, as a place in the picture. */
import type { BoardLook } from "../types";

export type Wish = BoardLook["wish"];
type Place = NonNullable<Wish["place"]>;
type Attitude = NonNullable<Wish["attitude"]>;

/** How the board is held: -1 to 1 across the picture and down, and as the simulated hand takes it. */
export interface Hold {
  readonly right: number;
  readonly down: number;
  readonly distance_mm: number;
  readonly left_away_deg: number;
  readonly top_away_deg: number;
  readonly turn_deg: number;
}

const ASIDE = 0.6;
const UP = 0.55;
const TIPPED_DEG = 28;
const STRAIGHT = { distance_mm: 380, left_away_deg: 0, top_away_deg: 0, turn_deg: 0 };

const PLACES: Readonly<Record<Place, readonly [right: number, down: number]>> = {
  upper_left: [-ASIDE, -UP],
  top: [0, -UP],
  upper_right: [ASIDE, -UP],
  left: [-ASIDE, 0],
  middle: [0, 0],
  right: [ASIDE, 0],
  lower_left: [-ASIDE, UP],
  bottom: [0, UP],
  lower_right: [ASIDE, UP],
};

const ATTITUDES: Readonly<Record<Attitude, Partial<Hold>>> = {
  left_away: { left_away_deg: TIPPED_DEG },
  right_away: { left_away_deg: -TIPPED_DEG },
  top_away: { top_away_deg: TIPPED_DEG },
  bottom_away: { top_away_deg: -TIPPED_DEG },
  turned: { turn_deg: 90 },
  nearer: { distance_mm: 300 },
  farther: { distance_mm: 460 },
};

/** How the board is to be held so that a wish comes true. */
export function holdFor({ place, attitude }: Wish): Hold {
  const [right, down] = PLACES[place ?? "middle"];
  return { right, down, ...STRAIGHT, ...(attitude === null ? {} : ATTITUDES[attitude]) };
}

const ACROSS = 168;
const HIGH = 216;
/** Distance at which a millimetre is one thousandth of the picture's width; roughly what cameras here see. */
const REACH_MM = 1.25;

type Corner = readonly [x: number, y: number];

/** Corners of a board held like that, in a picture of the given size: a hint, no measurement. */
export function outlineOf(hold: Hold, width: number, height: number): readonly Corner[] {
  const [left, top, turn] = [hold.left_away_deg, hold.top_away_deg, hold.turn_deg].map((angle) => (angle * Math.PI) / 180);
  const focal = width / REACH_MM;
  return [
    [-1, -1],
    [1, -1],
    [1, 1],
    [-1, 1],
  ].map(([a = 0, b = 0]): Corner => {
    const [flatX, flatY] = [(a * ACROSS) / 2, (b * HIGH) / 2];
    const x = flatX * Math.cos(turn!) - flatY * Math.sin(turn!);
    const y = flatX * Math.sin(turn!) + flatY * Math.cos(turn!);
    const z = hold.distance_mm - x * Math.sin(left!) - y * Math.sin(top!);
    return [
      (width * (1 + hold.right)) / 2 + (focal * x * Math.cos(left!)) / z,
      (height * (1 + hold.down)) / 2 + (focal * y * Math.cos(top!)) / z,
    ];
  });
}
