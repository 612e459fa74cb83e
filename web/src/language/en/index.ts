import { cards } from "./cards";
import { control } from "./control";
import { robot } from "./robot";

export { access } from "./access";
export { guidance } from "./guidance";
export const home = { ...robot, ...cards, control };
