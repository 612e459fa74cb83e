export * from "../en";
