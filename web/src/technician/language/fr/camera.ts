import { formatNumber } from "@/format";
import type { CameraWords } from "../types";

export const camera: CameraWords = {
  title: "Caméra",
  hint: "Étiquette, position, santé",
  loading: "En attente de la première image…",
  alt: "Image de la caméra sur le robot, maintenant",
  nothing: "Il n’y a pas d’étiquette lisible dans l’image.",
  stranger: "Cette étiquette n’est à aucune voiture connue ici, sa taille est donc inconnue.",
  trusted: "La position vient de tous les bords du code et a passé tous les contrôles.",
  coarse: "Seuls les coins vont\u00a0: bon à regarder, rien ne bouge d’après cela.",
  magnified: (times) =>
    `Ellipses\u00a0: où est le centre, 1 σ et 95 %, dessinées ${formatNumber(times, 0)} fois plus grandes.`,
  inliers: (share, count) => `${share} sur ${count}`,
  pose: {
    title: "Position vue de la caméra",
    x: "À droite",
    y: "En bas",
    z: "Devant",
    turnX: "Rotation autour de x",
    turnY: "Rotation autour de y",
    turnZ: "Rotation autour de z",
    residual: "Résidu",
    inliers: "Bords qui vont",
    vehicle: "Voiture",
  },
  health: {
    title: "Santé",
    rate: "Images",
    age: "Âge à l’examen",
    exposure: "Exposition",
    brightness: "Gris moyen, 0 à 255",
    dark: "Sans lumière",
    bright: "Saturé",
    rateOverTime: "Images, Hz",
    ageOverTime: "Âge à l’examen, ms",
    verdicts: {
      asking: ["Attente", "La première image n’est pas encore là."],
      slow: ["Lent", "Il vient peu d’images. L’ordinateur est-il occupé, la pose longue faute de lumière ou le réseau lent\u00a0?"],
      late: ["En retard", "Les images sont vieilles une fois examinées. L’ordinateur est-il occupé ou le réseau lent\u00a0?"],
      good: ["Bon", "Les images viennent assez souvent et assez tôt."],
    },
  },
  unknown: "–",
};
