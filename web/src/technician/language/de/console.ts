import type { ConsoleWords } from "../types";

export const console: ConsoleWords = {
  title: "Protokoll",
  hint: "Was zur Platine geht und kommt",
  list: "Rahmen, der neueste am Ende",
  direction: "Richtung",
  directions: { both: "Beide", to_board: "Zur Platine", from_board: "Von der Platine" },
  kind: "Art",
  kinds: { all: "Alle", worth: "Ohne Routine" },
  search: "Suche",
  errors: "Nur Fehler",
  pause: "Pause",
  go: "Weiter",
  clear: "Leeren",
  download: "Herunterladen",
  waiting: "Es wird mitgehört. Noch kam nichts Passendes.",
  unavailable: "Der Treiber dieser Platine kann nicht sagen, was über die Verbindung geht.",
  count: (shown, all) => `${String(shown)} von ${String(all)} Rahmen`,
  paused: "Pause: was jetzt kommt, wird nicht behalten.",
  lost: (count) => `${String(count)} Rahmen kamen zu schnell, um gelesen zu werden.`,
  file: "plugpilot-frames.txt",
};
