import type { ConfigWords } from "../types";

export const config: ConfigWords = {
  title: "Konfiguration",
  hint: "Einstellungen, Fassungen",
  loading: "Die Einstellungen werden gelesen …",
  notAllowed: "Nur Eigentümer lesen und ändern die Einstellungen.",
  atOnce: "Gilt sofort, ohne Neustart.",
  empty: "Leer: wie PlugPilot gestartet wurde.",
  limits: (least, most) => {
    if (least !== null && most !== null) return `${String(least)} bis ${String(most)}.`;
    if (least !== null) return `Mindestens ${String(least)}.`;
    return most === null ? "" : `Höchstens ${String(most)}.`;
  },
  noNumber: "Das ist keine Zahl.",
  noJson: "Das ist kein JSON, wie [1, 2] oder [\"a\"].",
  differences: "Was sich ändern würde",
  none: "Es wurde nichts geändert.",
  wrong: "Berichtigen Sie zuerst die markierten Felder.",
  save: "Speichern",
  saving: "Wird gespeichert …",
  saved: "Gespeichert. Es gilt jetzt.",
  discard: "Verwerfen",
  nothing: "(leer)",
  versions: "Fassungen",
  start: "Wie PlugPilot gestartet wurde",
  now: "gilt jetzt",
  back: "Zurück hierhin",
  sure: "Noch einmal drücken",
  noChanges: "keine Änderungen",
  file: "Einstellungen, die einen Neustart brauchen",
  fileHint:
    "Diese stehen in der Konfigurationsdatei, weil Bewegungen, Kräfte oder Verbindungen davon abhängen. Ändern Sie sie dort und starten Sie PlugPilot neu.",
  find: "Einstellung suchen",
  name: "Einstellung",
  value: "Geltender Wert",
  count: (shown, all) => `${String(shown)} von ${String(all)} Einstellungen`,
};
