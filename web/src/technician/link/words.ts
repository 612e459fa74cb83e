export { link as say } from "../language/spoken";
