import type { DiagnosticsWords } from "../types";

export const diagnostics: DiagnosticsWords = {
  title: "Diagnose und Versionen",
  hint: "Eine Datei für die Hilfe",
  explain:
    "Zustand, Einstellungen, Versionen, das neueste Protokoll, wer was tat, Aufträge und eine Sekunde der Verbindung zur Platine, in einer ZIP-Datei. Passwörter und Schlüssel sind unkenntlich; Namen von Personen und Adressen im Haus sind es nicht.",
  notAllowed: "Nur Eigentümer laden sie herunter.",
  download: "Diagnose herunterladen",
  collecting: "Wird gesammelt, ein bis zwei Sekunden …",
  done: (kilobytes) => `Heruntergeladen, ${String(kilobytes)} kB.`,
  news: "Was neu ist",
  newsInEnglish: "Die Notizen sind auf Englisch.",
  updated: (version) => `Aktualisiert auf ${version}: was neu ist`,
  putAway: "Ausblenden",
  versions: "Versionen",
  loading: "Die Versionen werden gelesen …",
  software: "PlugPilot",
  board: "Platine",
  firmware: "Firmware",
  protocol: "Protokoll",
  python: "Python",
  system: "System",
  unknown: "noch nicht bekannt",
  libraries: "Bibliotheken",
  unreachable: {
    code: "unreachable",
    title: "Keine Antwort",
    detail: "Der Roboter hat die Datei nicht geschickt.",
    remedy: "Prüfen Sie die Verbindung und versuchen Sie es erneut.",
  },
  file: "plugpilot-diagnostics.zip",
};
