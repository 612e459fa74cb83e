import { formatNumber } from "@/format";
import type { CameraWords } from "../types";

export const camera: CameraWords = {
  title: "Telecamera",
  hint: "Etichetta, posizione, stato",
  loading: "In attesa della prima immagine…",
  alt: "Immagine della telecamera sul robot, adesso",
  nothing: "Nell’immagine non c’è un’etichetta leggibile.",
  stranger: "Questa etichetta non è di nessuna auto conosciuta qui, perciò la sua misura è sconosciuta.",
  trusted: "La posizione viene da tutti i bordi del codice e ha superato ogni controllo.",
  coarse: "Vanno solo gli angoli: buono da guardare, nulla si muove in base a questo.",
  magnified: (times) =>
    `Ellissi: dov’è il centro, 1 σ e 95 %, disegnate ${formatNumber(times, 0)} volte più grandi.`,
  inliers: (share, count) => `${share} di ${count}`,
  pose: {
    title: "Posizione dalla telecamera",
    x: "A destra",
    y: "In basso",
    z: "Avanti",
    turnX: "Rotazione intorno a x",
    turnY: "Rotazione intorno a y",
    turnZ: "Rotazione intorno a z",
    residual: "Residuo",
    inliers: "Bordi che vanno",
    vehicle: "Auto",
  },
  health: {
    title: "Stato",
    rate: "Immagini",
    age: "Età all’esame",
    exposure: "Esposizione",
    brightness: "Grigio medio, da 0 a 255",
    dark: "Senza luce",
    bright: "Saturo",
    rateOverTime: "Immagini, Hz",
    ageOverTime: "Età all’esame, ms",
    verdicts: {
      asking: ["In attesa", "La prima immagine non c’è ancora."],
      slow: ["Lento", "Arrivano poche immagini. Il computer è occupato, l’esposizione lunga per poca luce o la rete lenta?"],
      late: ["In ritardo", "Le immagini sono vecchie quando sono esaminate. Il computer è occupato o la rete lenta?"],
      good: ["Bene", "Le immagini arrivano abbastanza spesso e abbastanza presto."],
    },
  },
  unknown: "–",
};
