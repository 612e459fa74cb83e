export { config as say } from "../language/spoken";
