import type { JobPhase, PlugState, RobotMode } from "@/api/wire";
import type { RobotWords } from "../types";

const plugStates: Record<PlugState, string> = {
  parked: "à sa place",
  free: "hors de la voiture",
  inserted: "dans la voiture",
  unknown: "inconnue",
};

const modes: Record<RobotMode, string> = {
  offline: "ne répond pas",
  off: "moteurs coupés",
  not_homed: "position inconnue",
  homing: "cherche sa position",
  ready: "prêt",
  moving: "en mouvement",
  stopping: "s’arrête",
  stopped: "arrêté",
  emergency_stop: "arrêt d’urgence",
  fault: "défaut",
};

const phases: Record<JobPhase, { step: string; headline: string; detail: string }> = {
  preflight: {
    step: "Préparation",
    headline: "Le robot se prépare",
    detail: "Il vérifie son état et celui de la borne de recharge.",
  },
  locating: {
    step: "Recherche de la prise",
    headline: "Recherche de la prise",
    detail: "La caméra cherche l’étiquette à côté de la prise de la voiture.",
  },
  aligning: {
    step: "Alignement",
    headline: "Approche de la voiture",
    detail: "Le connecteur s’aligne sur la prise. Restez à distance.",
  },
  inserting: {
    step: "Branchement",
    headline: "Branchement en cours",
    detail: "Le connecteur entre doucement dans la prise. Restez à distance.",
  },
  plugged: {
    step: "Branchée",
    headline: "La voiture est branchée",
    detail: "En attente du début de la charge.",
  },
  charging: {
    step: "Charge",
    headline: "Votre voiture charge",
    detail: "Le robot la débranchera quand ce sera terminé.",
  },
  releasing: {
    step: "Fin de la charge",
    headline: "Fin de la charge",
    detail: "Le courant est coupé et la prise se déverrouille.",
  },
  withdrawing: {
    step: "Débranchement",
    headline: "Débranchement en cours",
    detail: "Le connecteur sort de la voiture. Restez à distance.",
  },
  parking: {
    step: "Retour",
    headline: "Retour à sa place",
    detail: "Le bras se replie. Restez à distance.",
  },
};

export const robot: RobotWords = {
  phases,
  state: {
    connecting: { headline: "Un instant", detail: "Connexion au robot." },
    unreachable: {
      headline: "Robot injoignable",
      detail:
        "Cette page continue d’essayer. Vérifiez que le robot est sous tension et que vous êtes sur le réseau de la maison.",
    },
    outdated: {
      headline: "Cette page est trop ancienne",
      detail: "Le robot a reçu un nouveau logiciel. Rechargez la page.",
    },
    offline: {
      headline: "Le robot ne répond pas",
      detail: "Vérifiez qu’il est sous tension et que son câble est bien branché. Il revient tout seul.",
    },
    emergency: { headline: "Arrêt d’urgence", detail: "Tout est immobile." },
    emergencyRemedy:
      "Assurez-vous que personne n’est près du connecteur, puis levez l’arrêt.",
    stopped: {
      headline: "Arrêté",
      detail: "Le robot reste immobile jusqu’à ce que vous leviez l’arrêt.",
    },
    stopping: { headline: "Arrêt en cours", detail: "Le robot s’immobilise." },
    faultUnnamed: {
      headline: "Le robot a un problème",
      detail: "Il reste immobile jusqu’à ce que quelqu’un ait regardé.",
    },
    askPlug: {
      headline: "La voiture est-elle débranchée\u00a0?",
      detail: "Le robot ne peut pas le savoir. Il ne bougera qu’après que vous aurez regardé.",
    },
    pluggedIn: {
      headline: "La voiture est branchée",
      detail: "Débranchez-la quand vous en avez besoin.",
    },
    charging: {
      headline: "Votre voiture charge",
      detail: "Débranchez-la quand vous en avez besoin.",
    },
    homing: {
      headline: "Cherche sa position",
      detail: "Le robot se déplace lentement. Restez à distance.",
    },
    moving: { headline: "Le robot bouge", detail: "Restez à distance." },
    movingBy: (name) => `Aux commandes\u00a0: ${name}. Restez à distance.`,
    movingByJob: "Le robot travaille. Restez à distance.",
    off: {
      headline: "Prêt quand vous l’êtes",
      detail: "Le robot se repose. Il se réveille quand vous appuyez sur Charger.",
    },
    notHomed: {
      headline: "Prêt quand vous l’êtes",
      detail: "Le robot cherche d’abord sa position, puis il branche la voiture.",
    },
    ready: {
      headline: "Prêt à charger",
      detail: "Garez la voiture devant le robot et appuyez sur Charger.",
    },
    readyAfterCharge: {
      headline: "La charge est terminée",
      detail: "La voiture est débranchée. Vous pouvez partir.",
    },
    charged: (energy) => `${energy} chargés. La voiture est débranchée, vous pouvez partir.`,
    free: { headline: "Prêt à charger", detail: "La voiture n’est pas branchée." },
    queued: { headline: "Le robot se prépare", detail: "Il commence dans un instant." },
    planned: (start, end) => ({
      headline: "La charge est programmée",
      detail:
        end === null
          ? `Début\u00a0: ${start}. Laissez la voiture où elle est.`
          : `Début\u00a0: ${start}, prête au plus tard\u00a0: ${end}. Laissez la voiture où elle est.`,
    }),
    paused: {
      headline: "En pause",
      detail: "Le robot ne bouge plus et la voiture ne charge plus jusqu’à ce que vous repreniez.",
    },
    needsPerson: "Le robot a besoin de vous",
    cancelling: {
      headline: "Annulation",
      detail: "Le robot retourne à sa place. Restez à distance.",
    },
    ending: {
      headline: "Fin de la charge",
      detail: "Le robot débranche la voiture dans un instant.",
    },
    chargeFailed: "La voiture n’a pas pu être chargée",
    plugInFailed: "La voiture n’a pas pu être branchée",
    unplugFailed: "La voiture n’a pas pu être débranchée",
    failedUnnamed: "Le robot n’a pas donné de raison.",
    stillPlugged: "La voiture est encore branchée.",
  },
  action: {
    charge: "Charger",
    plan: "Programmer une charge",
    pause: "Pause",
    goOn: "Reprendre",
    giveUp: "Abandonner",
    again: "Réessayer",
    finish: "Arrêter et débrancher",
    unplug: "Débrancher",
    cancel: "Annuler",
    cancelPlan: "Annuler la programmation",
    release: "Lever l’arrêt",
    clear: "Effacer le défaut",
    plugOut: "Oui, elle est débranchée",
    plugIn: "Non, elle est encore branchée",
    guide: "Pas à pas",
    wake: "Touchez l’écran pour le réveiller.",
    busy: "Un instant…",
    stop: "Stop",
    stopHint: "Arrête aussitôt tout mouvement",
    stopping: "Arrêt en cours…",
    emergency: "Arrêt d’urgence",
    dismiss: "J’ai compris",
    back: "Pas encore",
  },
  confirmReset: {
    title: "Le robot peut-il de nouveau bouger\u00a0?",
    points: [
      "Personne n’est près du connecteur ni du bras.",
      "Le câble pend librement.",
      "Rien ne gêne le passage.",
    ],
    note: "Rien ne bouge tant que vous n’avez pas appuyé sur le bouton suivant.",
    yes: "Oui, lever l’arrêt",
  },
  confirmPlug: {
    title: "Avez-vous regardé\u00a0?",
    points: [
      "Le connecteur est entièrement sorti de la prise.",
      "Personne n’est près du connecteur ni du bras.",
    ],
    note: "En cas de doute, allez d’abord regarder.",
    yes: "Oui, elle est débranchée",
  },
  chooseCar: { title: "Quelle voiture\u00a0?" },
  noCar: {
    code: "no_vehicle",
    title: "Aucune voiture n’est encore connue",
    detail: "Le robot reconnaît une voiture à l’étiquette à côté de sa prise.",
    remedy: "Demandez à la personne qui s’occupe du robot d’ajouter votre voiture.",
  },
  trouble: {
    remedy: "Que faire\u00a0:",
    unreachable: {
      code: "unreachable",
      title: "Pas de réponse",
      detail: "Le robot n’a pas répondu.",
      remedy:
        "Vérifiez que vous êtes sur le réseau de la maison et que le robot est sous tension, puis réessayez.",
    },
    unexpected: {
      code: "unexpected",
      title: "Cela n’a pas marché",
      detail: "Cette page n’a pas compris la réponse.",
      remedy: "Rechargez la page. Si cela continue, redémarrez l’ordinateur du robot.",
    },
    stopUnsure: {
      code: "stop_unconfirmed",
      title: "L’arrêt n’a pas été confirmé",
      detail: "Le robot n’a pas répondu à Stop.",
      remedy: "Appuyez sur l’arrêt d’urgence du robot, ou coupez son alimentation.",
    },
  },
  link: {
    connecting: "Connexion",
    live: "En direct",
    lost: "Reconnexion",
    quiet: "Sans nouvelles",
  },
  simulator: (speed) => (speed === 1 ? "Simulateur" : `Simulateur ×${String(speed)}`),
  simulated: {
    car: "Voiture simulée",
    camera: "Caméra simulée",
    station: "Borne simulée",
  },
  robot: {
    title: "Robot",
    mode: "État",
    plug: "Connecteur",
    driver: "Connecté à",
    drives: "Moteurs",
    drivesOn: "en marche",
    drivesOff: "coupés",
    tip: "Bout du connecteur",
    force: "Force",
    socket: "Prise située à",
    simulated: "Simulé",
    simulatedParts: { robot: "robot", camera: "caméra", station: "borne de recharge" },
    version: "Logiciel",
    enable: "Allumer",
    disable: "Éteindre",
    home: "Chercher la position",
    technician: "Page du technicien",
    control: "Aux commandes",
    nobody: "personne",
    byJob: "la tâche en cours",
    modes,
    plugStates,
    unknown: "inconnu",
  },
};
