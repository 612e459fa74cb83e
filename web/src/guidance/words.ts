/** Every sentence of the parking guidance, in the language in force. */
export { guidance as say } from "@/language/spoken";
