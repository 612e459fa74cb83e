import type { ControlWords } from "../types";

/** Chi è ai comandi del robot, e che cosa ci si dice a riguardo. */
export const control: ControlWords = {
  person: (name, role) => `${name} (${role.toLowerCase()})`,
  asks: (who) => `${who} chiede i comandi`,
  asksDetail: "Ciò che si muove a mano allora si ferma. Un lavoro in corso continua.",
  keptIn: (seconds) => `Senza risposta restano qui: ${String(seconds)}\u00a0s.`,
  give: "Cedere i comandi",
  keep: "Tenere i comandi",
  held: (who) => `${who} è ai comandi`,
  heldDetail: "Si può guardare, e fermare il robot in ogni momento.",
  rival: (who) => `${who} li ha già chiesti.`,
  ask: "Chiedere i comandi",
  waiting: (who) => `Comandi chiesti a ${who}`,
  refusedIn: (seconds) => `Senza risposta non cambia nulla: ${String(seconds)}\u00a0s.`,
  withdraw: "Non chiedere più",
  answers: {
    given: (who) => `${who} ha ceduto i comandi`,
    kept: (who) => `${who} tiene i comandi`,
    unanswered: (who) => `${who} non ha risposto e tiene i comandi`,
    withdrawn: (who) => `${who} tiene i comandi`,
    ended: (who) => `${who} ha finito: ora i comandi sono qui`,
  },
  you: "chi usa questa pagina",
  doing: { job: "il lavoro in corso", homing: "la ricerca della posizione", calibration: "una calibrazione" },
  back: "Restituire i comandi",
};
