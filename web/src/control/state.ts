/** Who is in control of the robot, as this browser's person sees it. */
import { computed, effect, signal } from "@preact/signals";
import { session } from "@/access/session";
import { say as access } from "@/access/words";
import type { Control, ControlPerson, Live } from "@/api/wire";
import { store } from "@/live/page";
import { words } from "@/words";

const NOBODY: Control = {};

const myId = computed(() => session.value?.person?.id ?? null);
const control = computed(() => store.live.value?.control ?? NOBODY);

/** The request of this person whose answer is to be shown; null when there is none. */
export const awaited = signal<string | null>(null);

/** Somebody else is in control; null when nobody is, or this person. */
export const otherHolder = computed(() => {
  const holder = control.value.holder ?? null;
  return holder === null || holder.person.id === myId.value ? null : holder;
});

/** This person is in control. */
export const inControl = computed(() => {
  const holder = control.value.holder ?? null;
  return holder !== null && holder.person.id === myId.value;
});

/** Somebody asks this person for control. */
export const asked = computed(() => (inControl.value ? (control.value.request ?? null) : null));

/** This person asks for control. */
export const asking = computed(() => {
  const request = control.value.request ?? null;
  return request !== null && request.person.id === myId.value ? request : null;
});

effect(() => {
  if (asking.value !== null) awaited.value = asking.value.id;
});

/** Somebody else asks before this person could. */
export const rival = computed(() => {
  const request = control.value.request ?? null;
  return request === null || request.person.id === myId.value ? null : request.person;
});

/** What became of the request that this page has shown. */
export const answer = computed(() => {
  const newest = control.value.answer ?? null;
  return newest !== null && newest.request_id === awaited.value ? newest : null;
});

/** Seconds that are left for an answer, by the robot's clock. */
export const secondsLeft = computed(() => {
  const live = store.live.value;
  const ends = live?.control?.request?.ends_at;
  if (ends === undefined || live === null) return 0;
  return Math.max(0, Math.ceil((Date.parse(ends) - Date.parse(live.robot.updated_at)) / 1000));
});

/** A name, and what that person is to the robot. */
export const named = ({ name, role }: ControlPerson): string =>
  words.control.person(name, access.roles[role].name);

/** The person in control, and what moves the robot if that is not this person's hand. */
export function whoControls({ robot, control: now }: Live): string {
  const holder = now?.holder ?? null;
  const kind = robot.control?.kind ?? null;
  const parts = [];
  if (holder !== null) {
    parts.push(holder.person.id === myId.value ? words.control.you : holder.person.name);
  } else if (kind === "jog") parts.push(robot.control?.name ?? "");
  if (kind !== null && kind !== "jog") parts.push(words.control.doing[kind]);
  return parts.length === 0 ? words.robot.nobody : parts.join(", ");
}
