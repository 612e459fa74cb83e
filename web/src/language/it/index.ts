import type { HomeWords } from "../types";
import { cards } from "./cards";
import { control } from "./control";
import { robot } from "./robot";

export { access } from "./access";
export { guidance } from "./guidance";
export const home: HomeWords = { ...robot, ...cards, control };
