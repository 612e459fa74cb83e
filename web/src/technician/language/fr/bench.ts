import type { JogAxis, RobotMode } from "@/api/wire";
import { formatNumber } from "@/format";
import type { Direction } from "../../jog/axes";
import type { BenchWords } from "../types";
import { problems } from "./problems";

const not: Record<Exclude<RobotMode, "ready" | "moving">, string> = {
  offline: "Le robot ne répond pas.",
  off: "Les moteurs sont coupés\u00a0: mettez-les d’abord en marche.",
  not_homed: "La position est inconnue\u00a0: cherchez-la d’abord.",
  homing: "Le robot cherche sa position.",
  stopping: "Le robot s’immobilise.",
  stopped: "Quelqu’un a appuyé sur Stop\u00a0: levez d’abord l’arrêt.",
  emergency_stop: "Arrêt d’urgence\u00a0: levez-le d’abord.",
  fault: "Il y a un défaut\u00a0: effacez-le d’abord.",
};

const ways: Record<JogAxis, Record<Direction, string>> = {
  x: { [-1]: "En arrière le long du rail", 1: "En avant le long du rail" },
  y: { [-1]: "Vers le bas", 1: "Vers le haut" },
  insertion: { [-1]: "Loin de la voiture", 1: "Vers la voiture" },
  rho1: { [-1]: "Chariot gauche en arrière", 1: "Chariot gauche en avant" },
  rho2: { [-1]: "Chariot droit en arrière", 1: "Chariot droit en avant" },
  rho3: { [-1]: "Coulisse rentrée", 1: "Coulisse sortie" },
};

export const bench: BenchWords = {
  title: "Technique",
  panel: {
    loading: "Chargement…",
    away: "Cette partie n’a pas pu être chargée. Rechargez la page.",
  },
  robot: {
    title: "Robot",
    enable: "Allumer les moteurs",
    disable: "Couper les moteurs",
    find: "Chercher la position",
    release: "Lever",
    control: "Aux commandes",
    nobody: "personne",
  },
  jog: {
    title: "Déplacer à la main",
    frame: "Sens du mouvement",
    frames: { base: "Connecteur", joints: "Axes" },
    amount: "De combien, mm",
    hold: "Maintenu",
    speed: "Vitesse, mm/s",
    axes: { x: "x", y: "y", insertion: "Insertion", rho1: "ρ1", rho2: "ρ2", rho3: "ρ3" },
    ways,
    keys: "Touches\u00a0: flèches, Page préc. et Page suiv. tant que ce cadre est actif.",
    gamepad: "Manette\u00a0: maintenez L1 et poussez un stick. Relâcher L1 arrête.",
    left: (way_mm) => (way_mm === 0 ? "fin" : `${formatNumber(way_mm, 0)} mm`),
    notAllowed: "Vous pouvez regarder. Seuls les techniciens et les propriétaires déplacent le robot ici.",
    notLive: "La page n’a pas de valeurs récentes.",
    busy: "Le robot bouge.",
    controlled: (name) => `Aux commandes\u00a0: ${name}.`,
    onlyOut: "Le connecteur est peut-être dans une prise\u00a0: seule la sortie est ouverte.",
    ready: "Prêt. Le robot ne bouge que tant que vous maintenez un bouton.",
    readyStep: "Prêt. Chaque appui fait un pas.",
    not,
    noAnswer: {
      code: "no_answer",
      title: "Pas de réponse",
      detail: "Le robot n’a pas répondu, le mouvement a donc été arrêté.",
      remedy: "Vérifiez la connexion, puis réessayez.",
    },
  },
  values: {
    title: "Valeurs",
    joint: "Axe",
    commanded: "Consigne",
    measured: "Mesure",
    error: "Écart",
    tip: "Bout du connecteur",
    force: "Force",
    age: "Âge",
    unit: "mm",
    unknown: "–",
    joints: { rho1: "ρ1", rho2: "ρ2", rho3: "ρ3" },
  },
  plots: {
    title: "Au fil du temps",
    loading: "Chargement des courbes…",
    joints: "Axes, mm",
    errors: "Écart de poursuite, mm",
    force: "Force, N",
    forceWay: "Force selon la course de ρ3, N",
    out: "aller",
    back: "retour",
    hold: "Figer",
    go: "Reprendre",
  },
  problems,
  stop: {
    protective: "Stop",
    emergency: "Arrêt d’urgence",
    hint: "Arrête aussitôt tout mouvement. Tant que le robot bouge, la barre d’espace fait de même.",
  },
};
