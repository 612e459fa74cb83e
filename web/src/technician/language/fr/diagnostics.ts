import type { DiagnosticsWords } from "../types";

export const diagnostics: DiagnosticsWords = {
  title: "Diagnostic et versions",
  hint: "Un fichier pour qui vous aide",
  explain:
    "État, réglages, versions, journal récent, qui a fait quoi, tâches et une seconde de la liaison avec la carte, dans un fichier ZIP. Les mots de passe et les clés sont masqués\u00a0; les noms des personnes et les adresses de la maison ne le sont pas.",
  notAllowed: "Seuls les propriétaires le téléchargent.",
  download: "Télécharger le diagnostic",
  collecting: "Rassemblement, une seconde ou deux…",
  done: (kilobytes) => `Téléchargé, ${String(kilobytes)} ko.`,
  news: "Nouveautés",
  newsInEnglish: "Les notes sont en anglais.",
  updated: (version) => `Mis à jour vers ${version}\u00a0: nouveautés`,
  putAway: "Masquer",
  versions: "Versions",
  loading: "Lecture des versions…",
  software: "PlugPilot",
  board: "Carte",
  firmware: "Micrologiciel",
  protocol: "Protocole",
  python: "Python",
  system: "Système",
  unknown: "pas encore connu",
  libraries: "Bibliothèques",
  unreachable: {
    code: "unreachable",
    title: "Pas de réponse",
    detail: "Le robot n’a pas envoyé le fichier.",
    remedy: "Vérifiez la connexion, puis réessayez.",
  },
  file: "plugpilot-diagnostics.zip",
};
