import type { Tone } from "@/robot/describe";
import type { Scene } from "@/robot/scene";

interface PictureProps extends Scene {
  readonly tone: Tone;
}

/**
 * The wall, the robot and the nose of a car, seen from the side.
 *
 * Only attributes change; the style sheet moves the arm, so that every change is one smooth
 * motion. The sentence below says the same in words: screen readers skip the picture.
 */
export function Picture({ arm, mark, tone }: PictureProps) {
  return (
    <svg
      class="picture"
      viewBox="0 0 400 200"
      data-arm={arm}
      data-mark={mark}
      data-tone={tone}
      aria-hidden="true"
    >
      <ellipse class="shadow" cx="352" cy="183" rx="120" ry="6" />
      <path class="beam" d="M78 86 242 96v58z" />
      <Arm />
      <Wall />
      <Car />
      <Mark mark={mark} />
    </svg>
  );
}

function Wall() {
  return (
    <g>
      <rect class="wall" x="-400" y="-200" width="432" height="600" />
      <rect class="housing" x="26" y="62" width="58" height="98" rx="17" />
      <rect class="housing-face" x="34" y="70" width="42" height="82" rx="11" />
      <circle class="lens" cx="66" cy="86" r="6.5" />
      <circle class="lens-glint" cx="68" cy="84" r="1.8" />
      <rect class="lamp" x="43" y="82" width="8" height="8" rx="4" />
    </g>
  );
}

/** Three tubes that slide out of each other, the plug on the last one, and its cable. */
function Arm() {
  const cable = "M86 134C78 188 20 196-66 140";
  return (
    <g>
      <g class="slide third">
        <path class="cable" d={cable} />
        <path class="current" d={cable} />
      </g>
      <rect class="tube slide first" x="14" y="118" width="68" height="16" rx="3" />
      <rect class="tube slide second" x="14" y="120" width="68" height="12" rx="3" />
      <g class="slide third">
        <rect class="tube" x="36" y="122" width="56" height="8" rx="2" />
        <rect class="pins" x="108" y="120" width="11" height="12" rx="3" />
        <rect class="plug" x="82" y="113" width="24" height="26" rx="8" />
        <rect class="plug-ring" x="103" y="116" width="6" height="20" rx="3" />
      </g>
    </g>
  );
}

function Car() {
  return (
    <g>
      <path
        class="car"
        d="M246 158c-6-1-8-6-8-14l2-26c1-9 6-14 15-16l43-9c20-27 42-41 74-42l228-3v112z"
      />
      <path class="glass" d="M312 92c16-20 34-30 60-31l22-1v32z" />
      <path class="glass" d="M402 60l120-2v34H402z" />
      <path class="car-line" d="M398 62v88M300 93l-44 10" />
      <path class="light" d="M247 107c6-4 14-6 24-7-2 7-9 11-22 12-3 0-4-3-2-5z" />
      <circle class="arch" cx="306" cy="160" r="28" />
      <circle class="tyre" cx="306" cy="160" r="22.5" />
      <circle class="rim" cx="306" cy="160" r="12.5" />
      <circle class="tyre" cx="306" cy="160" r="3" />
      <rect class="socket" x="235" y="115" width="10" height="22" rx="5" />
      <g class="battery">
        <rect x="345" y="111" width="40" height="20" rx="6" />
        <path d="M388 117v8" />
        <rect class="cell" x="349" y="115" width="9" height="12" rx="2.5" />
        <rect class="cell" x="360.5" y="115" width="9" height="12" rx="2.5" />
        <rect class="cell" x="372" y="115" width="9" height="12" rx="2.5" />
      </g>
    </g>
  );
}

const MARKS: Record<Exclude<Scene["mark"], "none">, string> = {
  search: "M9 9m-6 0a6 6 0 1 0 12 0a6 6 0 1 0-12 0M13.5 13.5 19 19",
  bolt: "M12 2 5 12h5l-1 8 7-10h-5z",
  alert: "M11 5v7.5M11 17v.01",
  question: "M7.5 8.5a3.5 3.5 0 1 1 5 3.200c-1 .5-1.5 1.100-1.5 2.300M11 17.5v.01",
  asleep: "M6 6h10L6 16h10",
  sync: "M17 7.5A7 7 0 0 0 4.600 8.5M4.5 4.5v4h4M5 14.5a7 7 0 0 0 12.400-1M17.5 17.5v-4h-4",
};

function Mark({ mark }: { mark: Scene["mark"] }) {
  if (mark === "none") return null;
  return (
    <g class="mark" transform="translate(165 52)">
      <circle r="21" />
      <g class="mark-icon">
        <path transform="translate(-11 -11)" d={MARKS[mark]} />
      </g>
    </g>
  );
}
