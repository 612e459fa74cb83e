export { bench } from "./bench";
export { calibration } from "./calibration";
export { camera } from "./camera";
export { config } from "./config";
export { console } from "./console";
export { diagnostics } from "./diagnostics";
export { link } from "./link";
export { target } from "./target";
