/** What the server says in English about calibration. */
import type { CalibrationWords } from "../types";

const masculine = (side?: string): string => (side === "left" ? "gauche" : "droit");
const feminine = (side?: string): string => (side === "left" ? "gauche" : "droite");

export const doing: CalibrationWords["doing"] = {
  ready: "Le robot se prépare.",
  search: "Recherche de l’étiquette.",
  wiring: "Contrôle que chaque moteur déplace son chariot.",
  looks: "L’étiquette est regardée de beaucoup de points.",
  unmoved: "Contrôle que l’étiquette est où elle était.",
  solve: "Calcul de la construction du robot.",
  sides: "Chaque point est approché des deux côtés.",
  mated: "L’étiquette est regardée, connecteur dans la prise.",
  draw: "Le connecteur est retiré.",
  back: "L’étiquette est regardée, connecteur retiré.",
  kept: "L’étalonnage est terminé. Personne ne l’utilise encore.",
  checked: "La vérification est terminée.",
  board: "Recherche de la mire.",
  camera: "Calcul de la caméra d’après les images.",
  first: "Le robot va au premier point.",
  second: "Le robot va au second point.",
  rule: "Il manque ce que dit la règle.",
  homing: (done, total) => `Recherche de la position, ${done} sur ${total}.`,
  play: (side, from) => `Le chariot ${masculine(side)} revient au même point par le ${from === "below" ? "bas" : "haut"}.`,
  freely: (done, total) => `La glissière avance à vide, ${done} sur ${total}.`,
  spring: (done, total) => `Le ressort est poussé, ${done} sur ${total}.`,
};

export const remarks: CalibrationWords["remarks"] = {
  missed: (a) => `Des points mis de côté sont manqués de ${a} mm\u00a0: l’étiquette a-t-elle bougé, une courroie est-elle lâche, un chariot coince-t-il\u00a0?`,
  missedUsable: (a, b) => `Des points mis de côté sont manqués de ${a} mm\u00a0; un bon robot atteint ${b} mm. Tendez les courroies et répétez.`,
  worse: (a, b) => `L’étalonnage utilisé ne manque les mêmes points que de ${a} mm, celui-ci de ${b} mm.`,
  outliers: (a) => `${a} % des regards ne vont pas avec les autres\u00a0: quelque chose a bougé entre-temps.`,
  hidden: () => "Le connecteur cachait l’étiquette\u00a0: personne n’a vu si la voiture a bougé au retrait.",
  apart: (a) => `Les fins de course des deux chariots sont ${a} mm plus loin l’une de l’autre qu’avec l’étalonnage utilisé\u00a0: l’une a bougé.`,
  nearer: (a) => `Les fins de course des deux chariots sont ${a} mm plus près l’une de l’autre qu’avec l’étalonnage utilisé\u00a0: l’une a bougé.`,
  far: (what, difference) => `Loin du plan (${what})\u00a0: ${difference}. Mesurez à la main avant d’y croire.`,
  unseen: (what) => `${what}\u00a0: les regards en disent peu, et ce qui était connu avant reste.`,
  beltsOnly: () => "Seules les courroies ont été mesurées. Mesurez aussi le robot\u00a0: jambes et rails sont comme sur le plan.",
  loose: (side, a) => `La fin de course ${feminine(side)} ne se ferme qu’à ${a} mm près\u00a0: fixez-la, et regardez le jeu de son levier.`,
  play: (side, a) => `Le chariot ${masculine(side)} a ${a} mm de jeu\u00a0: tendez sa courroie, et regardez poulie et engrenage.`,
  lag: (side, a) => `Le chariot ${masculine(side)} a ${a} mm de retard pendant qu’il bouge.`,
  friction: (a) => `La glissière demande ${a} N pour bouger à vide\u00a0: nettoyez et graissez sa vis.`,
  offset: (a) => `Sans aucune force, le courant du moteur montre ${a} N\u00a0: quelque chose tire sur la glissière, le câble par exemple.`,
  scale: (a) => `La force affichée vaut ${a} fois la vraie\u00a0: mettez cette version en vigueur, ou corrigez la force du moteur pour son courant dans les réglages de la carte et recommencez.`,
  lens: () => "Les valeurs de la caméra sont celles de sa fiche technique, et le robot vise d’après elles\u00a0: étalonnez la caméra avec la mire, puis recommencez.",
  edges: (a) => `Au bord de l’espace de travail, le connecteur peut encore être à ${a} mm\u00a0: mesurez les courroies sur 400 mm et l’étiquette au pied à coulisse, placez l’étiquette près du milieu de l’espace de travail, et répétez.`,
  corners: (a) => `Les coins ont en moyenne ${a} px d’écart\u00a0: la mire est-elle plate, la mise au point fixe, et rien de flou\u00a0?`,
  focal: (a) => `La focale n’est sûre qu’à ${a} % près\u00a0: prenez plus d’images de biais et à des distances différentes.`,
  centre: (a) => `Le centre n’est sûr qu’à ${a} px près\u00a0: tournez la mire d’un quart de tour sur quelques images, et inclinez-la.`,
  cover: (a) => `La mire a été dans ${a} % de l’image\u00a0: tenez-la là où elle n’était pas.`,
  angle: (a, b) => `Seules ${a} images montrent la mire de biais\u00a0; il en faut ${b} ou plus.`,
  held: (a) => `Des images mises de côté vont moins bien (${a} px)\u00a0: prenez plus d’images.`,
  leftOut: (a) => `${a} images ont dû être écartées\u00a0: la mire s’est-elle pliée, ou la mise au point a-t-elle bougé\u00a0?`,
  places: (a, b) => `AP + RP va jusqu’à ${a} mm\u00a0; ${b} mm sont demandés.`,
  mostPlay: () => "C’est surtout du jeu\u00a0: tendez les courroies, puis vérifiez de nouveau.",
  off: () => "Les points sont décalés, mais se répètent\u00a0: mesurez le robot, puis vérifiez de nouveau.",
  unsteady: () => "Les points ne se répètent pas\u00a0: regardez si un chariot coince.",
  unknowns: {
    left_leg: "longueur de la jambe gauche",
    right_leg: "longueur de la jambe droite",
    right_foot_x: "distance des deux chariots",
    right_foot_y: "hauteur du chariot droit au-dessus du gauche",
    half_skew: "angle entre les deux rails",
    left_scale: "course de la courroie gauche",
    right_scale: "course de la courroie droite",
    camera_x: "inclinaison de la caméra",
    camera_y: "orientation de la caméra",
    camera_z: "roulis de la caméra",
    label_x: "place de l’étiquette le long du rail",
    label_y: "hauteur de l’étiquette",
    label_z: "distance de l’étiquette",
    label_ratio: "taille de l’étiquette",
  },
};

export const questions: CalibrationWords["questions"] = {
  camera_enough: () => "Arrêtez quand vous voulez\u00a0: ce qui est là peut être calculé maintenant.",
  belts_marked: () => "Marquez sur le rail où sont les deux chariots, puis confirmez.",
  belts_left: () => "De combien le chariot gauche s’est-il éloigné de sa marque\u00a0?",
  belts_right: () => "De combien le chariot droit s’est-il éloigné de sa marque\u00a0?",
  force_clear: (a) => `Ne laissez rien à moins de ${a} mm devant le connecteur, puis confirmez.`,
  force_spring: (a) => `Placez le ressort de ${a} N/mm bien droit devant le connecteur, contre quelque chose de solide, puis confirmez. Le connecteur va le comprimer.`,
};

export const hints: CalibrationWords["hints"] = {
  belts_drifted: [
    "Le robot a dérivé plus que ce qui était prouvé",
    (moved, proven, side, stretch) =>
      `Depuis sa mesure, des points ont bougé de ${moved} mm au plus\u00a0; ${proven} mm étaient prouvés. La courroie ${feminine(side)} fait ${stretch} % par rapport à alors. Regardez sa tension, puis mesurez le robot.`,
  ],
  looks_misfit: [
    "Ce que voient les tâches ne va pas avec l’étalonnage",
    (count) =>
      `Dans ${count} tâches de suite, l’étiquette a semblé bouger. Rien n’en a été appris. Regardez si courroies, fins de course et caméra tiennent bien, puis mesurez le robot.`,
  ],
  plug_heavy: [
    "Le connecteur entre plus difficilement qu’avant",
    (depth, count, mean, lower, upper) =>
      `À ${depth} mm de profondeur, les ${count} dernières fois ont demandé ${mean} N\u00a0; d’habitude ${lower} à ${upper} N. Nettoyez le connecteur et la prise, et cherchez des contacts pliés.`,
  ],
  plug_light: [
    "Le connecteur entre plus facilement qu’avant",
    (depth, count, mean, lower, upper) =>
      `À ${depth} mm de profondeur, les ${count} dernières fois ont demandé ${mean} N\u00a0; d’habitude ${lower} à ${upper} N. Ses contacts sont peut-être usés\u00a0: faites contrôler le connecteur et la prise.`,
  ],
  slide_heavy: [
    "La glissière bouge plus difficilement qu’avant",
    (now, usual) => `Devant la prise, elle demande ${now} N\u00a0; d’habitude ${usual} N. Nettoyez et graissez sa vis.`,
  ],
  socket_off: [
    "La prise n’est pas où le dit son étiquette",
    (right, up, car) =>
      `Les derniers connecteurs sont entrés ${right} mm à droite et ${up} mm plus haut. Regardez si l’étiquette de ${car} s’est décollée, puis apprenez la prise de nouveau.`,
  ],
};
