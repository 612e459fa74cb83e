import type { Sentences } from "@/guidance/instruction";
import type { GuidanceWords } from "../types";

const sentences: Sentences = {
  reasons: {
    disabled: [
      "Aide au stationnement désactivée",
      "Elle est désactivée dans les réglages.",
      "Mettez guidance.enabled à true.",
    ],
    robot_offline: [
      "Pas d’aide pour le moment",
      "Le robot ne répond pas\u00a0: impossible de savoir où se trouve sa caméra.",
    ],
    robot_busy: ["Pas d’aide pour le moment", "Le robot travaille. Ne déplacez pas la voiture."],
    robot_not_homed: [
      "Pas encore d’aide",
      "Le robot ne connaît pas sa propre position, ni donc celle de sa caméra.",
      "Il la retrouvera à la prochaine charge. Vous pouvez aussi la lancer dans la carte «\u00a0Robot\u00a0».",
    ],
    robot_not_parked: [
      "N’entrez pas",
      "Le robot n’est pas à sa place.",
      "Attendez qu’il soit rangé, ou ramenez-le à sa place.",
    ],
    plug_held: ["Ne déplacez pas la voiture", "La prise y est branchée, ou l’est peut-être."],
    camera_down: [
      "La caméra ne répond pas",
      "Sans image, impossible de dire jusqu’où avancer.",
      "Vérifiez le câble de la caméra. Au besoin, garez-vous à l’œil.",
    ],
    nothing: ["En attente d’une voiture", "L’étiquette près de la prise de la voiture n’est pas visible."],
    too_far: ["Approchez lentement", "L’étiquette est encore trop loin pour être lue."],
    too_dirty: [
      "L’étiquette est illisible",
      "Elle est sale, abîmée ou en partie cachée.",
      "Arrêtez-vous, essuyez l’étiquette, puis continuez.",
    ],
    too_dark: ["Il fait trop sombre", "La caméra ne voit presque rien.", "Allumez la lumière."],
    too_bright: [
      "Il y a trop de lumière",
      "La caméra est éblouie.",
      "Protégez la caméra de la lumière, ou passez en feux de croisement.",
    ],
    other_label: [
      "Cette étiquette n’est pas connue ici",
      "Elle appartient à une autre voiture, ou à un autre robot.",
      "Ajoutez d’abord la voiture, ou imprimez son étiquette avec ce robot.",
    ],
    twice: [
      "Deux étiquettes sont visibles",
      "Toutes deux disent être la même voiture.",
      "Retirez la copie.",
    ],
    mirrored: [
      "L’étiquette est inversée",
      "La caméra semble regarder dans un miroir.",
      "Retirez le miroir.",
    ],
    no_vehicle: [
      "Aucune voiture n’est encore connue",
      "Le robot ne sait pas à qui est l’étiquette qu’il voit.",
      "Ajoutez d’abord une voiture et imprimez son étiquette.",
    ],
    hidden: [
      "Stop\u00a0: l’étiquette est cachée",
      "Elle était visible il y a un instant. Quelque chose la cache.",
      "Retirez ce qui est devant, ou essuyez-la.",
    ],
    left_at_left: [
      "Stop\u00a0: l’étiquette est sortie de l’image",
      "Pour le robot, la prise est trop à gauche.",
      "Reculez un peu, jusqu’à ce qu’elle soit de nouveau visible.",
    ],
    left_at_right: [
      "Stop\u00a0: l’étiquette est sortie de l’image",
      "Pour le robot, la prise est trop à droite.",
      "Reculez un peu, jusqu’à ce qu’elle soit de nouveau visible.",
    ],
    left_at_top: [
      "Stop\u00a0: l’étiquette est sortie de l’image",
      "Pour le robot, la prise est trop haute.",
      "Reculez un peu, jusqu’à ce qu’elle soit de nouveau visible.",
    ],
    left_at_bottom: [
      "Stop\u00a0: l’étiquette est sortie de l’image",
      "Pour le robot, la prise est trop basse.",
      "Reculez un peu, jusqu’à ce qu’elle soit de nouveau visible.",
    ],
    rolls: ["", "Tout droit."],
    too_fast: ["", "Ralentissez."],
    askew: ["", "Vous arrivez de travers\u00a0: redressez."],
    stands: [
      "",
      "Le robot n’atteint pas encore la prise.",
      "Reculez et revenez en visant plus de ce côté.",
    ],
    too_low: [
      "La prise est {distance} trop bas",
      "Le robot ne peut pas descendre jusque-là.",
      "Se garer autrement n’y changera rien\u00a0: faites poser le robot plus bas, ou prenez un autre robot.",
    ],
    too_high: [
      "La prise est {distance} trop haut",
      "Le robot ne peut pas monter jusque-là.",
      "Se garer autrement n’y changera rien\u00a0: faites poser le robot plus haut, ou prenez un autre robot.",
    ],
    stop: ["Stop", "Freinez maintenant."],
    good: ["Arrêtez-vous ici", "La voiture est bien placée. Vous pouvez descendre."],
    good_flawed: [
      "Arrêtez-vous ici",
      "La voiture est bien placée, mais son étiquette n’a pas l’aspect attendu.",
      "Essuyez l’étiquette avant de charger.",
    ],
    thin: ["Tout juste à portée", "Vous pouvez rester là, mais il s’en faut de peu."],
    skewed: [
      "La voiture est de travers",
      "La prise est tournée de {skew}°\u00a0; le robot peut suivre {limit}° au plus.",
      "Vérifiez que l’étiquette et la prise sont placées comme lors de l’apprentissage.",
    ],
    skewed_left: [
      "La voiture est de travers",
      "La prise est tournée de {skew}°\u00a0; le robot peut suivre {limit}° au plus.",
      "Reculez et revenez plus droit\u00a0: l’avant est trop tourné vers la gauche.",
    ],
    skewed_right: [
      "La voiture est de travers",
      "La prise est tournée de {skew}°\u00a0; le robot peut suivre {limit}° au plus.",
      "Reculez et revenez plus droit\u00a0: l’avant est trop tourné vers la droite.",
    ],
  },
  first: {
    forward: "Avancez de {distance}",
    back: "Reculez de {distance}",
    left: "{distance} à gauche",
    right: "{distance} à droite",
    up: "{distance} trop bas",
    down: "{distance} trop haut",
  },
  further: {
    forward: "avancez de {distance}",
    back: "reculez de {distance}",
    left: "{distance} plus à gauche",
    right: "{distance} plus à droite",
  },
  and: " et ",
  also: "Et {steps}.",
  better: "Mieux\u00a0: {steps}.",
};

export const guidance: GuidanceWords = {
  title: "Aide au stationnement",
  show: "Afficher",
  hide: "Masquer",
  directions: {
    forward: "en avant",
    back: "en arrière",
    left: "à gauche",
    right: "à droite",
    up: "trop bas",
    down: "trop haut",
  },
  sentences,
  picture: "Vu d’en haut\u00a0: le robot, les places à sa portée et la prise de la voiture.",
  legendReach: "à portée",
  robot: "Robot",
  skew: (degrees, limit) => `de travers\u00a0: ${degrees}° sur ${limit}°`,
  sigma: (mm) => `prise située à ± ${mm} mm`,
  simulated: {
    title: "Vous conduisez la voiture simulée",
    driveIn: "Entrer",
    brake: "Freiner",
    forward: "Avancer de 5 cm",
    back: "Reculer de 5 cm",
    leave: "Partir",
  },
};
