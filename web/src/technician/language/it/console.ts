import type { ConsoleWords } from "../types";

export const console: ConsoleWords = {
  title: "Console del protocollo",
  hint: "Trame da e verso la scheda",
  list: "Trame, la più recente in fondo",
  direction: "Verso",
  directions: { both: "Entrambi", to_board: "Alla scheda", from_board: "Dalla scheda" },
  kind: "Tipo",
  kinds: { all: "Tutte", worth: "Senza routine" },
  search: "Ricerca",
  errors: "Solo errori",
  pause: "Pausa",
  go: "Continua",
  clear: "Svuota",
  download: "Scarica",
  waiting: "In ascolto. Nulla di adatto è ancora passato.",
  unavailable: "Il driver di questa scheda non sa dire che cosa passa sul collegamento.",
  count: (shown, all) => `${String(shown)} di ${String(all)} trame`,
  paused: "In pausa: ciò che passa ora non si tiene.",
  lost: (count) => `${String(count)} trame sono passate troppo in fretta per essere lette.`,
  file: "plugpilot-frames.txt",
};
