import { formatNumber } from "@/format";
import type { CameraWords } from "../types";

export const camera: CameraWords = {
  title: "Kamera",
  hint: "Marke, Lage, Zustand",
  loading: "Warten auf das erste Bild …",
  alt: "Bild der Kamera auf dem Roboter, jetzt",
  nothing: "Im Bild ist keine lesbare Marke.",
  stranger: "Diese Marke gehört zu keinem Auto, das hier bekannt ist; ihre Größe ist daher unbekannt.",
  trusted: "Die Lage folgt aus allen Kanten des Codes und hat jede Prüfung bestanden.",
  coarse: "Nur die Ecken passen: gut zum Ansehen, bewegt wird danach nichts.",
  magnified: (times) => `Ellipsen: wo die Mitte liegt, 1 σ und 95 %, ${formatNumber(times, 0)}-mal so groß gezeichnet.`,
  inliers: (share, count) => `${share} von ${count}`,
  pose: {
    title: "Lage, von der Kamera aus",
    x: "Rechts",
    y: "Unten",
    z: "Voraus",
    turnX: "Drehung um x",
    turnY: "Drehung um y",
    turnZ: "Drehung um z",
    residual: "Restfehler",
    inliers: "Passende Kanten",
    vehicle: "Auto",
  },
  health: {
    title: "Zustand",
    rate: "Bilder",
    age: "Alter beim Auswerten",
    exposure: "Belichtung",
    brightness: "Mittleres Grau, 0 bis 255",
    dark: "Ohne Licht",
    bright: "Übersteuert",
  },
  unknown: "–",
};
