import { configure } from "@testing-library/preact";

// The whole page in an error message hides the error.
configure({ getElementError: (message) => new Error(message ?? "not found") });
