/** Every sentence of the home page, in the language in force. */
export { home as words } from "@/language/spoken";
