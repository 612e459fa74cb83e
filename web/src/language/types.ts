/** What every language has to say: all that English says. */
import type { access } from "./en/access";
import type { cards } from "./en/cards";
import type { control } from "./en/control";
import type { guidance } from "./en/guidance";
import type { guides } from "./en/guides";
import type { robot } from "./en/robot";
import type { trail } from "./en/trail";

export type RobotWords = typeof robot;
export type CardWords = typeof cards;
export type ControlWords = typeof control;
export type HomeWords = RobotWords & CardWords & { readonly control: ControlWords };
export type AccessWords = typeof access;
export type GuidanceWords = typeof guidance;
export type GuideWords = typeof guides;
export type TrailWords = typeof trail;
