/** What the drawings of the guides are put together from, each around its own origin. */
import type { ComponentChildren } from "preact";

interface AtProps {
  readonly x: number;
  readonly y: number;
  readonly size?: number;
  readonly children: ComponentChildren;
}

/** Puts a part somewhere, in another size. */
export function At({ x, y, size = 1, children }: AtProps) {
  return <g transform={`translate(${String(x)} ${String(y)}) scale(${String(size)})`}>{children}</g>;
}

/** The wall with the robot on it; its arm reaches so far to the right. */
export function Robot({ reach = 0 }: { reach?: number }) {
  const tip = 34 + reach;
  return (
    <g>
      <path class="fill" d="M-8 0h16v90H-8z" />
      <rect class="paper" x="6" y="26" width="18" height="40" rx="6" />
      <circle class="ink" cx="16" cy="34" r="2.5" />
      <path d={`M24 50h${String(tip - 34)}`} />
      <PlugHead x={tip} />
    </g>
  );
}

function PlugHead({ x }: { x: number }) {
  return (
    <g>
      <rect class="ink" x={x - 10} y="42" width="12" height="16" rx="4" />
      <path d={`M${String(x + 2)} 46h5M${String(x + 2)} 54h5`} />
    </g>
  );
}

/** The nose of a car with its socket, seen from the side. */
export function Car() {
  return (
    <g>
      <path class="fill" d="M0 66V46c0-6 4-9 10-10l16-4c10-13 16-18 30-18h20v52z" />
      <path class="paper" d="M34 30c6-7 12-9 20-9h10v9z" />
      <circle class="ink" cx="30" cy="66" r="10" />
      <circle class="paper" cx="30" cy="66" r="4" />
      <rect class="ink" x="-2" y="43" width="6" height="14" rx="3" />
    </g>
  );
}

/** The socket from the front, in the body of the car. */
export function Socket() {
  return (
    <g>
      <circle class="paper" r="17" />
      {[-7, 0, 7].map((x) => (
        <circle key={x} class="ink" cx={x} cy="-3" r="2.2" />
      ))}
      <circle class="ink" cx="-4" cy="6" r="2.2" />
      <circle class="ink" cx="4" cy="6" r="2.2" />
    </g>
  );
}

/** The label with its code. */
export function Label() {
  return (
    <g>
      <rect class="paper" x="-13" y="-13" width="26" height="26" rx="3" />
      <path class="ink" d="M-9-9h7v7h-7zM3-9h6v5H3zM-9 4h5v5h-5zM0 2h4v4H0zM5 6h4v3H5zM4-1h5v2H4z" />
    </g>
  );
}

export function Eye() {
  return (
    <g>
      <path class="paper" d="M-15 0c8-12 22-12 30 0-8 12-22 12-30 0z" />
      <circle class="ink" r="5" />
    </g>
  );
}

export function Person() {
  return (
    <g>
      <circle class="paper" cy="-17" r="7" />
      <path class="paper" d="M-11 17V3c0-7 4-10 11-10s11 3 11 10v14" />
    </g>
  );
}

export function Tick() {
  return <path class="good" d="M-8 0l5 6L8-7" />;
}

export function Cross() {
  return <path class="bad" d="M-7-7 7 7M7-7-7 7" />;
}

/** Goes so far, with its head at the end. */
export function Arrow({ to }: { to: readonly [number, number] }) {
  const [x, y] = to;
  const turn = (Math.atan2(y, x) * 180) / Math.PI;
  return (
    <g class="accent">
      <path d={`M0 0 ${String(x)} ${String(y)}`} />
      <path transform={`translate(${String(x)} ${String(y)}) rotate(${String(turn)})`} d="M-7-6 0 0l-7 6" />
    </g>
  );
}

/** Turning to the right. */
export function Turn() {
  return <path class="accent" d="M-20 4a20 20 0 0 1 37-13M17-20v11H6" />;
}

export function Bolt() {
  return <path class="accent" d="M3-14-8 3h7l-2 12L9-3H2z" />;
}

/** The charging station with its lamp. */
export function Station({ lamp }: { lamp: boolean }) {
  return (
    <g>
      <rect class="paper" x="-17" y="-28" width="34" height="50" rx="7" />
      <circle class={lamp ? "accent-fill" : "fill"} cy="-15" r="5" />
      <path d="M-8-2H8M17 8c10 0 12 6 12 14s-6 12-14 12h-6" />
    </g>
  );
}

export function Waves() {
  return <path class="accent" d="M-6 0a9 9 0 0 1 12 0M-12-7a18 18 0 0 1 24 0M-18-14a27 27 0 0 1 36 0M0 6v.1" />;
}

/** A cable with a flat plug at its end. */
export function UsbPlug() {
  return (
    <g>
      <rect class="paper" x="-10" y="-8" width="20" height="16" rx="3" />
      <rect class="fill" x="10" y="-5" width="10" height="10" />
      <path d="M-10 0h-16" />
    </g>
  );
}

export function Lamp() {
  return (
    <g>
      <path class="paper" d="M-6 9c0-6-6-8-6-15a12 12 0 0 1 24 0c0 7-6 9-6 15zM-4 14h8" />
      <path class="accent" d="M0-24v-5M17-17l4-4M-17-17l-4-4M22-4h5M-22-4h-5" />
    </g>
  );
}

export function Padlock() {
  return (
    <g>
      <rect class="paper" x="-12" y="-2" width="24" height="19" rx="4" />
      <path d="M-7-2v-8a7 7 0 0 1 13.500-2.500" />
      <circle class="ink" cy="6" r="2.500" />
      <path d="M0 7v4" />
    </g>
  );
}

export function Clock() {
  return (
    <g>
      <circle class="paper" r="17" />
      <path class="accent" d="M0-10V0l7 5" />
    </g>
  );
}

export function Phone() {
  return (
    <g>
      <rect class="paper" x="-12" y="-22" width="24" height="44" rx="5" />
      <path d="M-3 16h6" />
      <path class="accent" d="M-5-8c0 8 5 13 12 14M-5-8l5-2 2 5-3 3M7 6l1-5-5-2-3 3" />
    </g>
  );
}
