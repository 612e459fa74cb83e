import type { JobPhase, PlugState, RobotMode } from "@/api/wire";
import type { RobotWords } from "../types";

const plugStates: Record<PlugState, string> = {
  parked: "al suo posto",
  free: "fuori dall’auto",
  inserted: "nell’auto",
  unknown: "non nota",
};

const modes: Record<RobotMode, string> = {
  offline: "non risponde",
  off: "motori spenti",
  not_homed: "posizione non nota",
  homing: "cerca la posizione",
  ready: "pronto",
  moving: "in movimento",
  stopping: "si sta fermando",
  stopped: "fermo",
  emergency_stop: "arresto di emergenza",
  fault: "guasto",
};

const phases: Record<JobPhase, { step: string; headline: string; detail: string }> = {
  preflight: {
    step: "Preparazione",
    headline: "Il robot si prepara",
    detail: "Controlla sé stesso e la stazione di ricarica.",
  },
  locating: {
    step: "Ricerca della presa",
    headline: "Ricerca della presa",
    detail: "La telecamera cerca l’etichetta accanto alla presa dell’auto.",
  },
  aligning: {
    step: "Allineamento",
    headline: "Si avvicina all’auto",
    detail: "La spina si allinea alla presa. Tenersi a distanza.",
  },
  inserting: {
    step: "Collegamento",
    headline: "Sta collegando",
    detail: "La spina entra con delicatezza nella presa. Tenersi a distanza.",
  },
  plugged: {
    step: "Collegata",
    headline: "L’auto è collegata",
    detail: "In attesa che l’auto inizi a ricaricarsi.",
  },
  charging: {
    step: "Ricarica",
    headline: "L’auto si sta ricaricando",
    detail: "Alla fine il robot la scollega.",
  },
  releasing: {
    step: "Fine ricarica",
    headline: "Fine della ricarica",
    detail: "La corrente viene tolta e la presa si sblocca.",
  },
  withdrawing: {
    step: "Scollegamento",
    headline: "Sta scollegando",
    detail: "La spina esce dall’auto. Tenersi a distanza.",
  },
  parking: {
    step: "Ritorno",
    headline: "Torna al suo posto",
    detail: "Il braccio si ripiega. Tenersi a distanza.",
  },
};

export const robot: RobotWords = {
  phases,
  state: {
    connecting: { headline: "Un momento", detail: "Connessione al robot." },
    unreachable: {
      headline: "Robot non raggiungibile",
      detail:
        "Questa pagina continua a provare. Controllare che il robot sia alimentato e che il dispositivo sia nella rete di casa.",
    },
    outdated: {
      headline: "Questa pagina è superata",
      detail: "Il robot ha un nuovo software. Ricaricare la pagina.",
    },
    offline: {
      headline: "Il robot non risponde",
      detail: "Controllare che sia alimentato e che il cavo sia inserito. Ritorna da solo.",
    },
    emergency: { headline: "Arresto di emergenza", detail: "È tutto fermo." },
    emergencyRemedy:
      "Assicurarsi che nessuno sia vicino alla spina, poi sbloccare l’arresto.",
    stopped: {
      headline: "Fermo",
      detail: "Il robot resta fermo finché non si sblocca l’arresto.",
    },
    stopping: { headline: "Si sta fermando", detail: "Il robot si arresta." },
    faultUnnamed: {
      headline: "Il robot ha un problema",
      detail: "Resta fermo finché qualcuno non ha guardato.",
    },
    askPlug: {
      headline: "La spina è fuori dall’auto?",
      detail: "Il robot non può saperlo. Si muoverà solo dopo che qualcuno ha guardato.",
    },
    pluggedIn: {
      headline: "L’auto è collegata",
      detail: "Si può scollegare quando serve l’auto.",
    },
    charging: {
      headline: "L’auto si sta ricaricando",
      detail: "Si può scollegare quando serve l’auto.",
    },
    homing: {
      headline: "Cerca la posizione",
      detail: "Il robot si muove lentamente. Tenersi a distanza.",
    },
    moving: { headline: "Il robot si muove", detail: "Tenersi a distanza." },
    movingBy: (name) => `Ai comandi: ${name}. Tenersi a distanza.`,
    movingByJob: "Il robot sta lavorando. Tenersi a distanza.",
    off: {
      headline: "Tutto pronto",
      detail: "Il robot riposa. Si sveglia quando si preme Ricarica.",
    },
    notHomed: {
      headline: "Tutto pronto",
      detail: "Il robot cerca prima la sua posizione, poi collega l’auto.",
    },
    ready: {
      headline: "Pronto a ricaricare",
      detail: "Parcheggiare l’auto davanti al robot e premere Ricarica.",
    },
    readyAfterCharge: {
      headline: "Ricarica completata",
      detail: "La spina è fuori dall’auto. Si può partire.",
    },
    charged: (energy) => `${energy} ricaricati. La spina è fuori, si può partire.`,
    free: { headline: "Pronto a ricaricare", detail: "La spina è fuori dall’auto." },
    queued: { headline: "Il robot si prepara", detail: "Comincia tra un momento." },
    planned: (start, end) => ({
      headline: "La ricarica è programmata",
      detail:
        end === null
          ? `Inizio: ${start}. Lasciare l’auto dov’è.`
          : `Inizio: ${start}, pronta al più tardi: ${end}. Lasciare l’auto dov’è.`,
    }),
    paused: {
      headline: "In pausa",
      detail: "Il robot è fermo e l’auto non si ricarica finché non si riprende.",
    },
    needsPerson: "Serve un aiuto",
    cancelling: {
      headline: "Annullamento",
      detail: "Il robot torna al suo posto. Tenersi a distanza.",
    },
    ending: { headline: "Fine della ricarica", detail: "Tra un momento il robot scollega l’auto." },
    chargeFailed: "Non è stato possibile ricaricare l’auto",
    plugInFailed: "Non è stato possibile collegare l’auto",
    unplugFailed: "Non è stato possibile scollegare l’auto",
    failedUnnamed: "Il robot non ha indicato il motivo.",
    stillPlugged: "La spina è ancora nell’auto.",
  },
  action: {
    charge: "Ricarica",
    plan: "Programma una ricarica",
    pause: "Pausa",
    goOn: "Riprendi",
    giveUp: "Rinuncia",
    again: "Riprova",
    finish: "Termina e scollega",
    unplug: "Scollega",
    cancel: "Annulla",
    cancelPlan: "Annulla il programma",
    release: "Sblocca l’arresto",
    clear: "Cancella il guasto",
    plugOut: "Sì, è fuori",
    plugIn: "No, è ancora dentro",
    guide: "Passo per passo",
    wake: "Toccare lo schermo per riattivarlo.",
    busy: "Un momento…",
    stop: "Stop",
    stopHint: "Ferma subito ogni movimento",
    stopping: "Si sta fermando…",
    emergency: "Arresto di emergenza",
    dismiss: "Ho capito",
    back: "Non ancora",
  },
  confirmReset: {
    title: "Il robot può muoversi di nuovo?",
    points: [
      "Nessuno è vicino alla spina o al braccio.",
      "Il cavo pende libero.",
      "Non c’è nulla in mezzo.",
    ],
    note: "Nulla si muove finché non si preme il prossimo pulsante.",
    yes: "Sì, sblocca",
  },
  confirmPlug: {
    title: "Qualcuno ha guardato?",
    points: [
      "La spina è completamente fuori dalla presa.",
      "Nessuno è vicino alla spina o al braccio.",
    ],
    note: "In caso di dubbio, andare prima a guardare.",
    yes: "Sì, è fuori",
  },
  chooseCar: { title: "Quale auto?" },
  noCar: {
    code: "no_vehicle",
    title: "Nessuna auto è ancora conosciuta",
    detail: "Il robot riconosce un’auto dall’etichetta accanto alla presa.",
    remedy: "Chiedere a chi si occupa del robot di aggiungere l’auto.",
  },
  trouble: {
    remedy: "Che cosa fare:",
    unreachable: {
      code: "unreachable",
      title: "Nessuna risposta",
      detail: "Il robot non ha risposto.",
      remedy:
        "Controllare che il dispositivo sia nella rete di casa e che il robot sia alimentato, poi riprovare.",
    },
    unexpected: {
      code: "unexpected",
      title: "Non ha funzionato",
      detail: "Questa pagina non ha capito la risposta.",
      remedy: "Ricaricare la pagina. Se il problema resta, riavviare il computer del robot.",
    },
    stopUnsure: {
      code: "stop_unconfirmed",
      title: "L’arresto non è stato confermato",
      detail: "Il robot non ha risposto allo stop.",
      remedy: "Premere l’arresto di emergenza sul robot, o togliere l’alimentazione.",
    },
  },
  link: {
    connecting: "Connessione",
    live: "In diretta",
    lost: "Riconnessione",
    quiet: "Nessun dato",
  },
  simulator: (speed) => (speed === 1 ? "Simulatore" : `Simulatore ×${String(speed)}`),
  simulated: {
    car: "Auto simulata",
    camera: "Telecamera simulata",
    station: "Stazione simulata",
  },
  robot: {
    title: "Robot",
    mode: "Stato",
    plug: "Spina",
    driver: "Collegato a",
    drives: "Motori",
    drivesOn: "accesi",
    drivesOff: "spenti",
    tip: "Punta della spina",
    force: "Forza",
    socket: "Presa trovata a",
    simulated: "Simulato",
    simulatedParts: { robot: "robot", camera: "telecamera", station: "stazione di ricarica" },
    version: "Software",
    enable: "Accendi",
    disable: "Spegni",
    home: "Cerca la posizione",
    technician: "Pagina del tecnico",
    control: "Ai comandi",
    nobody: "nessuno",
    byJob: "l’attività in corso",
    modes,
    plugStates,
    unknown: "non nota",
  },
};
