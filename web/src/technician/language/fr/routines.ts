/** What each routine is called, wants prepared, and wants to be told. */
import type { CalibrationWords } from "../types";

export const routines: CalibrationWords["routines"] = {
  camera: {
    name: "Étalonner la caméra",
    purpose: "Focale, centre et distorsion, d’après des images de la mire imprimée que vous tenez.",
    prepare: [
      "Imprimez la mire à 100 %, et collez-la sur quelque chose de plat et de rigide.",
      "Mesurez le côté de ses carrés, de préférence sur cinq d’entre eux, et notez-le ici.",
      "Laissez le robot là où vous atteignez la caméra, et placez-vous de façon à voir cette page. Il ne bouge pas.",
    ],
    start: "Commencer",
    done: "La caméra est étalonnée",
  },
  switches: {
    name: "Fins de course",
    purpose: "Si elles se répètent bien\u00a0: le robot cherche plusieurs fois sa position et regarde où il se trouve ensuite.",
    prepare: [
      "Placez une voiture avec son étiquette devant le robot, frein serré.",
      "Laissez le connecteur pendre librement au robot.",
      "À partir de maintenant, personne ne touche la voiture, l’étiquette ni le robot.",
    ],
    start: "Mesurer",
    done: "Les fins de course sont mesurées",
  },
  play: {
    name: "Jeu des chariots",
    purpose: "Amène chaque chariot au même point des deux côtés\u00a0: l’écart est le jeu de sa courroie.",
    prepare: [
      "Placez une voiture avec son étiquette devant le robot, frein serré.",
      "Laissez le connecteur pendre librement au robot.",
      "À partir de maintenant, personne ne touche la voiture, l’étiquette ni le robot.",
    ],
    start: "Mesurer",
    done: "Le jeu est mesuré",
  },
  belts: {
    name: "Course des courroies",
    purpose: "Déplace les deux chariots le long du rail et demande de combien ils ont vraiment bougé.",
    prepare: [
      "Préparez une règle d’un demi-mètre et un crayon.",
      "Laissez le connecteur pendre librement au robot. Aucune voiture n’est nécessaire.",
      "Le robot s’arrête deux fois et demande\u00a0: marquez où sont les chariots, puis mesurez de combien ils ont bougé.",
    ],
    start: "Aller au premier point",
    done: "Les courroies sont mesurées",
  },
  robot: {
    name: "Mesurer le robot",
    purpose: "Jambes, rails, courroies et rotation de la caméra, par 25 regards sur une étiquette.",
    prepare: [
      "Placez la voiture pour que son étiquette soit devant le milieu du robot. Une étiquette sur une planche bien fixe convient aussi.",
      "Mesurez d’abord la course des deux courroies, et entrez ici ce que disait la règle. L’échelle de tout ne vient que de là.",
      "À partir de maintenant, personne ne touche la voiture, l’étiquette ni le robot.",
    ],
    start: "Mesurer",
    done: "Le robot est mesuré",
  },
  force: {
    name: "Force de la glissière",
    purpose: "Frottement de la glissière par des courses à vide et, contre un ressort, si la force affichée est juste.",
    prepare: [
      "Laissez le connecteur pendre librement au robot. Aucune voiture ne doit être juste devant.",
      "Éloignez les mains du connecteur.",
      "Si vous avez un ressort de raideur connue, le robot le demande quand il en a besoin.",
    ],
    start: "Commencer les courses",
    done: "La glissière est mesurée",
  },
  socket: {
    name: "Apprendre une prise",
    purpose: "Où est la prise par rapport à son étiquette, connecteur enfoncé à fond.",
    prepare: [
      "Mesurez d’abord le robot\u00a0: un autre étalonnage du robot déplace ce qui a été appris.",
      "Amenez le connecteur jusqu’au fond. Avancez doucement à la main et sentez le jeu des deux côtés, ou laissez une tâche brancher.",
      "Le robot regarde, retire le connecteur le long de son axe et regarde de nouveau. La voiture ne doit pas bouger.",
    ],
    start: "Il est au fond\u00a0: apprendre",
    done: "La prise est apprise",
  },
  check: {
    name: "Vérifier en neuf points",
    purpose: "Avec quelle précision le robot va là où on l’envoie, selon l’ISO 9283.",
    prepare: [
      "Placez la voiture pour que son étiquette soit devant le milieu du robot\u00a0: elle doit être dans l’image depuis quatre points au moins.",
      "Le robot va en neuf points, à chacun par le bas et par le haut.",
      "À partir de maintenant, personne ne touche la voiture, l’étiquette ni le robot.",
    ],
    start: "Vérifier",
    done: "La vérification est terminée",
  },
};

export const fields: CalibrationWords["fields"] = {
  leftSent: "Chariot gauche\u00a0: demandé, mm",
  leftWent: "vraiment fait, mm",
  rightSent: "Chariot droit\u00a0: demandé, mm",
  rightWent: "vraiment fait, mm",
  label: "Côté de l’étiquette mesuré à ± mm",
  approaches: "Approches de chaque point, de chaque côté",
  homings: "Nombre de recherches de position",
  reversals: "Approches avec chaque chariot, de chaque côté",
  distance: "Longueur du trajet, mm",
  reading: "Règle lue à ± mm",
  strokes: "Courses, aller et retour",
  stroke: "Longueur d’une course, mm",
  spring: "Raideur du ressort, N/mm",
  springKnown: "Raideur connue à ± %",
  square: "Côté d’un carré, mm",
};

export const fieldHints: CalibrationWords["fieldHints"] = {
  belts: "Laissez vide ce que la mesure des courroies a donné et qui est utilisé. Sans l’un ni l’autre, l’échelle n’est connue qu’à un quart de pour cent.",
  spring: "Sans ressort, laissez la raideur vide\u00a0: le frottement est mesuré quand même.",
};
