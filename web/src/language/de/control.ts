import type { ControlWords } from "../types";

/** Wer den Roboter steuert, und was man einander darüber sagt. */
export const control: ControlWords = {
  person: (name, role) => `${name} (${role})`,
  asks: (who) => `${who} möchte den Roboter übernehmen`,
  asksDetail: "Was Sie von Hand bewegen, hält dann an. Ein laufender Auftrag geht weiter.",
  keptIn: (seconds) => `Ohne Antwort steuern Sie weiter: ${String(seconds)}\u00a0s.`,
  give: "Übergeben",
  keep: "Behalten",
  held: (who) => `${who} steuert den Roboter`,
  heldDetail: "Sie können zusehen und den Roboter jederzeit anhalten.",
  rival: (who) => `${who} hat schon darum gebeten.`,
  ask: "Um Übergabe bitten",
  waiting: (who) => `Sie haben ${who} um die Übergabe gebeten`,
  refusedIn: (seconds) => `Ohne Antwort bleibt es, wie es ist: ${String(seconds)}\u00a0s.`,
  withdraw: "Nicht mehr bitten",
  answers: {
    given: (who) => `${who} hat Ihnen den Roboter übergeben`,
    kept: (who) => `${who} steuert weiter`,
    unanswered: (who) => `${who} hat nicht geantwortet und steuert weiter`,
    withdrawn: (who) => `${who} steuert weiter`,
    ended: (who) => `${who} ist fertig: Sie steuern den Roboter`,
  },
  you: "Sie",
  doing: { job: "der laufende Auftrag", homing: "die Positionssuche", calibration: "eine Kalibrierung" },
  back: "Steuern beenden",
};
