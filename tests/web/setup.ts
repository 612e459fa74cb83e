import { configure } from "@testing-library/preact";
import type { DetachedWindowAPI } from "happy-dom";

// The whole page in an error message hides the error.
configure({ getElementError: (message) => new Error(message ?? "not found") });

// Frames open, but every page in them is empty: nothing leaves the test.
const { settings } = (window as unknown as { happyDOM: DetachedWindowAPI }).happyDOM;
settings.enableIframePageLoading = true;
settings.fetch.interceptor = {
  beforeAsyncRequest: ({ window: page }) => Promise.resolve(new page.Response("<p>3D view</p>")),
};
