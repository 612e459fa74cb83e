export { camera as say } from "../language/spoken";
