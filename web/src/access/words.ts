/** Every sentence about access, in the language in force. */
export { access as say } from "@/language/spoken";
