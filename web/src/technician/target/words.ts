export { target as say } from "../language/spoken";
