/** What the server says in English about calibration, in the reader's language. */
import { language } from "@/language/language";
import { localised } from "./localised";
import { say } from "./words";

/** What a routine is doing, as the server says it. */
export const DOINGS = {
  ready: "Making the robot ready.",
  search: "Looking for the label.",
  wiring: "Checking that each motor moves its own carriage.",
  looks: "Looking at the label from many places.",
  unmoved: "Looking whether the label is where it was.",
  solve: "Working out how the robot is built.",
  sides: "Approaching each place from both sides.",
  mated: "Looking at the label with the plug in the socket.",
  draw: "Drawing the plug out.",
  back: "Looking at the label with the plug drawn back.",
  first: "Going to the first place.",
  second: "Going to the second place.",
  rule: "Waiting for what the rule says.",
  board: "Watching for the board.",
  camera: "Working out the camera from the pictures.",
  kept: "The calibration is done. Nobody uses it yet.",
  checked: "The check is done.",
} as const;

/** The same, where it counts or names something. */
const COUNTED = {
  homing: /^Homing, (\d+) of (\d+)\.$/,
  play: /^Bringing the (left|right) carriage to the same place from (below|above)\.$/,
  freely: /^Moving the slide freely, (\d+) of (\d+)\.$/,
  spring: /^Pushing the spring, (\d+) of (\d+)\.$/,
} as const;

export type Doings = Readonly<Record<keyof typeof DOINGS, string>> &
  Readonly<Record<keyof typeof COUNTED, (...found: string[]) => string>>;

/** What is solved for, as the server calls it. */
export const UNKNOWNS = {
  left_leg: "The length of the left leg",
  right_leg: "The length of the right leg",
  right_foot_x: "The distance of the two carriages",
  right_foot_y: "The height of the right carriage over the left one",
  half_skew: "The angle between the two rails",
  left_scale: "The travel of the left belt",
  right_scale: "The travel of the right belt",
  camera_x: "The camera's tilt up or down",
  camera_y: "The camera's turn to a side",
  camera_z: "The camera's roll",
  label_x: "The label's place along the rail",
  label_y: "The label's height",
  label_z: "The label's distance",
  label_ratio: "The label's size",
} as const;

export type Unknowns = Readonly<Record<keyof typeof UNKNOWNS, string>>;

/** Remarks of a verdict, each with a place for everything in it that varies. */
const REMARKS = {
  missed: /^Places that were held back are missed by ([\d.]+) mm: did/,
  missedUsable: /^Places that were held back are missed by ([\d.]+) mm; a good robot manages ([\d.]+) mm/,
  worse: /^The calibration in use misses the same places by ([\d.]+) mm only; this one by ([\d.]+) mm/,
  outliers: /^([\d.]+) % of the looks do not fit/,
  hidden: /^The plug hid the label/,
  apart: /^The limit switches of the two carriages are ([\d.]+) mm further apart/,
  nearer: /^The limit switches of the two carriages are ([\d.]+) mm nearer together/,
  beltsOnly: /^Only the belts were measured/,
  loose: /^The (left|right) switch closes within (-?[\d.]+) mm only/,
  play: /^The (left|right) carriage has (-?[\d.]+) mm of play/,
  lag: /^The (left|right) carriage lags by ([\d.]+) mm/,
  friction: /^The slide takes (-?[\d.]+) N to move freely/,
  offset: /^Without any force the motor current shows (-?[\d.]+) N/,
  lens: /^The camera's own numbers are those of its data sheet/,
  edges: /^At the edges of the workspace the plug may still be ([\d.]+) mm off/,
  corners: /^The corners are ([\d.]+) px off/,
  focal: /^The focal length is sure to ([\d.]+) %/,
  centre: /^The centre is sure to ([\d.]+) px/,
  cover: /^The board has been in ([\d.]+) % of the picture/,
  angle: /^Only (\d+) pictures show the board at an angle; take (\d+)/,
  held: /^Pictures that were held back fit worse \(([\d.]+) px\)/,
  leftOut: /^(\d+) pictures had to be left out/,
  places: /^AP \+ RP is up to ([\d.]+) mm; ([\d.]+) mm/,
  mostPlay: /^Most of it is play/,
  off: /^The places are off, but repeat/,
  unsteady: /^The places do not repeat/,
  scale: /^The shown force is ([\d.]+) times the true one/,
} as const;

const FAR = /^(.+) differs from the drawing by ([+-][\d.]+) (mm|degrees|%): /;
const UNSEEN = /^(.+): the looks say little about that/;

export type Remarks = Readonly<Record<keyof typeof REMARKS, (...found: string[]) => string>> & {
  /** What is solved for, in the words of the reader. */
  readonly unknowns: Unknowns;
  readonly far: (what: string, difference: string) => string;
  readonly unseen: (what: string) => string;
};

/** What a routine is doing. */
export function doingOf(sentence: string): string {
  const words = say.doing;
  if (words === null) return sentence;
  const known = Object.entries(DOINGS).find(([, each]) => each === sentence);
  if (known !== undefined) return words[known[0] as keyof typeof DOINGS];
  for (const [name, pattern] of Object.entries(COUNTED)) {
    const found = pattern.exec(sentence);
    if (found !== null) return words[name as keyof typeof COUNTED](...found.slice(1));
  }
  return sentence;
}

/** A remark in the reader's language; one that is not known stays as the server said it. */
export function remarkOf(sentence: string): string {
  const words = say.remarks;
  if (words === null) return sentence;
  for (const [name, pattern] of Object.entries(REMARKS)) {
    const found = pattern.exec(sentence);
    if (found !== null) return words[name as keyof typeof REMARKS](...found.slice(1).map(localised));
  }
  const far = FAR.exec(sentence);
  const [, what = "", difference = "", unit = ""] = far ?? [];
  const named = unknownOf(what, words);
  if (named === null) return sentence;
  return words.far(named, `${localised(difference)} ${unit === "degrees" ? "°" : unit}`);
}

/** What the looks did not tell, in the reader's language. */
export function unseenOf(sentence: string): string {
  const words = say.remarks;
  const names = UNSEEN.exec(sentence)?.[1]?.split(" and ").map((name) => words && unknownOf(name, words));
  if (words === null || names === undefined || names.includes(null)) return sentence;
  const [first = "", ...others] = new Intl.ListFormat(language.value, { type: "conjunction" }).format(names as string[]);
  return words.unseen(first.toLocaleUpperCase(language.value) + others.join(""));
}

/** Something solved for, by what the server calls it, at the beginning of a sentence or within. */
function unknownOf(name: string, words: Remarks): string | null {
  const found = Object.entries(UNKNOWNS).find(([, each]) => each.toLowerCase() === name.toLowerCase());
  return found === undefined ? null : words.unknowns[found[0] as keyof Unknowns];
}
