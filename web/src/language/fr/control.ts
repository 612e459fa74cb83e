import type { ControlWords } from "../types";

/** Qui est aux commandes du robot, et ce qu’on se dit à ce sujet. */
export const control: ControlWords = {
  person: (name, role) => `${name} (${role.toLowerCase()})`,
  asks: (who) => `${who} demande les commandes`,
  asksDetail: "Ce que vous déplacez à la main s’arrête alors. Une tâche en cours continue.",
  keptIn: (seconds) => `Sans réponse, vous les gardez\u00a0: ${String(seconds)}\u00a0s.`,
  give: "Donner les commandes",
  keep: "Garder les commandes",
  held: (who) => `${who} est aux commandes`,
  heldDetail: "Vous pouvez regarder, et arrêter le robot à tout moment.",
  rival: (who) => `${who} les a déjà demandées.`,
  ask: "Demander les commandes",
  waiting: (who) => `Vous avez demandé les commandes à ${who}`,
  refusedIn: (seconds) => `Sans réponse, rien ne change\u00a0: ${String(seconds)}\u00a0s.`,
  withdraw: "Ne plus demander",
  answers: {
    given: (who) => `${who} vous a donné les commandes`,
    kept: (who) => `${who} garde les commandes`,
    unanswered: (who) => `${who} n’a pas répondu et garde les commandes`,
    withdrawn: (who) => `${who} garde les commandes`,
    ended: (who) => `${who} a fini\u00a0: vous êtes aux commandes`,
  },
  you: "vous",
  doing: { job: "la tâche en cours", homing: "la recherche de position", calibration: "un étalonnage" },
  back: "Rendre les commandes",
};
