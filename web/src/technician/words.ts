export { bench as say } from "./language/spoken";
