export { console as say } from "../language/spoken";
