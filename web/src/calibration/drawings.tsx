/** Small drawings of what is to be prepared: the robot on its wall, the car, the label. */
import type { ComponentChildren } from "preact";

export type DrawingName = "looks" | "mated" | "nine" | "switches" | "play" | "belts" | "force" | "board";

const DRAWINGS: Readonly<Record<DrawingName, ComponentChildren>> = {
  // The label in the middle, seen from many places.
  looks: (
    <>
      <Rail />
      <path class="thin" d="M22 44 36 56M44 36v18M66 44 52 56M26 60h8M62 60h-8M44 78v-8" />
      <g class="dots">
        <circle cx="19" cy="41" r="3" />
        <circle cx="44" cy="32" r="3" />
        <circle cx="69" cy="41" r="3" />
        <circle cx="22" cy="60" r="3" />
        <circle cx="66" cy="60" r="3" />
        <circle cx="44" cy="81" r="3" />
      </g>
      <Label x={38} y={56} />
    </>
  ),
  // Hands hold the board at an angle.
  board: (
    <>
      <path d="M22 18 68 10v62L22 64z" />
      <path
        class="label-fill"
        d="m22 18 12-2v15l-12 1zM45 14l12-2v18l-12 1zM34 31l11-1v16l-11 1zM57 30l11-1v19l-11-1zM22 32v0M22 47l12 0v15l-12-3zM45 47l12 0v20l-12-3z"
      />
      <path class="thin" d="M14 30v24m-5-6 5 6 5-6M78 54V30m-5 6 5-6 5 6M30 80h28m-6-5 6 5-6 5" />
    </>
  ),
  // The plug all the way in the socket, the label beside it.
  mated: (
    <>
      <path class="car" d="M52 14h18q12 0 12 12v44q0 12-12 12H52z" />
      <path class="plug" d="M6 40h24v-6h26v24H30v-6H6z" />
      <path class="thin" d="M38 72H14m8-6-8 6 8 6" />
      <Label x={62} y={20} />
    </>
  ),
  // A carriage runs against its switch, again and again.
  switches: (
    <>
      <Rail />
      <path d="M12 30v40M12 44h8v12h-8" />
      <rect x="46" y="36" width="28" height="28" rx="5" />
      <path class="thin" d="M40 50H26m6-5-6 5 6 5M40 74c-8 8-20 4-20-4M40 82V73h-9" />
    </>
  ),
  // A carriage comes to one place from both sides.
  play: (
    <>
      <Rail />
      <rect x="30" y="32" width="28" height="28" rx="5" />
      <path class="thin" d="M8 46h14m-5-5 5 5-5 5M80 46H66m5-5-5 5 5 5" />
      <path class="thin" d="M40 72v12M48 72v12M30 78h6M52 78h6" />
    </>
  ),
  // A carriage has gone from its mark; the rule says how far.
  belts: (
    <>
      <Rail />
      <path class="thin" d="M18 26v28M18 40h26m-6-5 6 5-6 5" />
      <rect x="52" y="28" width="24" height="24" rx="5" />
      <path d="M8 64h72v16H8zM18 64v7M28 64v5M38 64v7M48 64v5M58 64v7M68 64v5" />
    </>
  ),
  // The plug pushes a spring against something firm.
  force: (
    <>
      <path class="plug" d="M4 42h16v-6h18v20H20v-6H4z" />
      <path d="m40 46 5-9 7 18 7-18 7 18 5-9" />
      <path class="rail" d="M78 22v48" />
      <path class="thin" d="M14 76h28m-6-5 6 5-6 5" />
    </>
  ),
  // Nine places, each from below and from above.
  nine: (
    <>
      <Rail />
      <g class="dots">
        {[20, 44, 68].flatMap((x) => [36, 56, 76].map((y) => <circle key={`${String(x)} ${String(y)}`} cx={x} cy={y} r="3" />))}
      </g>
      <path class="thin" d="M32 82V66m-4 5 4-5 4 5M56 30v16m-4-5 4 5 4-5" />
    </>
  ),
};

function Rail() {
  return <path class="rail" d="M8 14h72M20 10v8M68 10v8" />;
}

function Label({ x, y }: { x: number; y: number }) {
  return (
    <g class="label" transform={`translate(${String(x)} ${String(y)})`}>
      <rect width="12" height="12" rx="1.5" />
      <path d="M2 2h3v3H2zM7 2h3v3H7zM2 7h3v3H2zM7 7h1v1H7zM9 9h1v1H9z" />
    </g>
  );
}

/** Says nothing that the words beside it do not. */
export function Drawing({ name }: { name: DrawingName }) {
  return (
    <svg class="drawing" viewBox="0 0 88 92" aria-hidden="true">
      {DRAWINGS[name]}
    </svg>
  );
}
