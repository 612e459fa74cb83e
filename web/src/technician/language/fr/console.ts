import type { ConsoleWords } from "../types";

export const console: ConsoleWords = {
  title: "Console du protocole",
  hint: "Trames de et vers la carte",
  list: "Trames, la plus récente à la fin",
  direction: "Sens",
  directions: { both: "Les deux", to_board: "Vers la carte", from_board: "De la carte" },
  kind: "Genre",
  kinds: { all: "Tous", worth: "Sans la routine" },
  search: "Recherche",
  errors: "Erreurs seules",
  pause: "Pause",
  go: "Reprendre",
  clear: "Vider",
  download: "Télécharger",
  waiting: "À l’écoute. Rien qui convienne n’est encore passé.",
  unavailable: "Le pilote de cette carte ne sait pas dire ce qui passe sur sa liaison.",
  count: (shown, all) => `${String(shown)} trames sur ${String(all)}`,
  paused: "En pause\u00a0: ce qui passe n’est pas gardé.",
  lost: (count) => `${String(count)} trames sont passées trop vite pour être lues.`,
  file: "plugpilot-frames.txt",
};
