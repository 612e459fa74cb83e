export { diagnostics as say } from "../language/spoken";
