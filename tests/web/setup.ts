import { configure } from "@testing-library/preact";
import { speak } from "@/language/catalogue";
import "@/technician/language/spoken";
import "@/language/spoken";
import type { DetachedWindowAPI } from "happy-dom";

// The whole page in an error message hides the error.
configure({ getElementError: (message) => new Error(message ?? "not found") });

// Frames open, but every page in them is empty: nothing leaves the test.
const { settings } = (window as unknown as { happyDOM: DetachedWindowAPI }).happyDOM;
settings.enableIframePageLoading = true;
settings.fetch.interceptor = {
  beforeAsyncRequest: ({ window: page }) => Promise.resolve(new page.Response("<p>3D view</p>")),
};

// Most tests read English; another language is spoken by those that are about it.
await speak("en");
