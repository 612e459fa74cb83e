import type { DiagnosticsWords } from "../types";

export const diagnostics: DiagnosticsWords = {
  title: "Diagnosi e versioni",
  hint: "Un file per chi aiuta",
  explain:
    "Stato, impostazioni, versioni, registro recente, chi ha fatto che cosa, lavori e un secondo del collegamento con la scheda, in un file ZIP. Password e chiavi sono nascoste; i nomi delle persone e gli indirizzi di casa no.",
  notAllowed: "Lo scaricano solo i proprietari.",
  download: "Scarica la diagnosi",
  collecting: "Raccolta, un secondo o due…",
  done: (kilobytes) => `Scaricato, ${String(kilobytes)} kB.`,
  news: "Novità",
  newsInEnglish: "Le note sono in inglese.",
  updated: (version) => `Aggiornato a ${version}: novità`,
  putAway: "Nascondi",
  versions: "Versioni",
  loading: "Lettura delle versioni…",
  software: "PlugPilot",
  board: "Scheda",
  firmware: "Firmware",
  protocol: "Protocollo",
  python: "Python",
  system: "Sistema",
  unknown: "non ancora noto",
  libraries: "Librerie",
  unreachable: {
    code: "unreachable",
    title: "Nessuna risposta",
    detail: "Il robot non ha mandato il file.",
    remedy: "Controllare la connessione e riprovare.",
  },
  file: "plugpilot-diagnostics.zip",
};
