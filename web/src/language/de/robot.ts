import type { JobPhase, PlugState, RobotMode } from "@/api/wire";
import type { RobotWords } from "../types";

const plugStates: Record<PlugState, string> = {
  parked: "an seinem Platz",
  free: "nicht im Auto",
  inserted: "im Auto",
  unknown: "nicht bekannt",
};

const modes: Record<RobotMode, string> = {
  offline: "antwortet nicht",
  off: "Antriebe aus",
  not_homed: "Position nicht bekannt",
  homing: "sucht seine Position",
  ready: "bereit",
  moving: "bewegt sich",
  stopping: "hält an",
  stopped: "angehalten",
  emergency_stop: "Not-Halt",
  fault: "Störung",
};

const phases: Record<JobPhase, { step: string; headline: string; detail: string }> = {
  preflight: {
    step: "Vorbereiten",
    headline: "Gleich geht es los",
    detail: "Der Roboter prüft sich selbst und die Ladestation.",
  },
  locating: {
    step: "Ladedose suchen",
    headline: "Sucht die Ladedose",
    detail: "Die Kamera sucht das Etikett neben der Ladedose des Autos.",
  },
  aligning: {
    step: "Ausrichten",
    headline: "Fährt zum Auto",
    detail: "Der Stecker wird zur Ladedose ausgerichtet. Bitte Abstand halten.",
  },
  inserting: {
    step: "Einstecken",
    headline: "Steckt ein",
    detail: "Der Stecker geht sanft in die Ladedose. Bitte Abstand halten.",
  },
  plugged: {
    step: "Eingesteckt",
    headline: "Das Auto ist angesteckt",
    detail: "Warte darauf, dass das Auto zu laden beginnt.",
  },
  charging: {
    step: "Laden",
    headline: "Ihr Auto lädt",
    detail: "Wenn es fertig ist, zieht der Roboter den Stecker.",
  },
  releasing: {
    step: "Laden beenden",
    headline: "Beendet das Laden",
    detail: "Der Strom wird abgeschaltet, und die Ladedose entriegelt.",
  },
  withdrawing: {
    step: "Ausstecken",
    headline: "Steckt aus",
    detail: "Der Stecker kommt aus dem Auto. Bitte Abstand halten.",
  },
  parking: {
    step: "Zurückfahren",
    headline: "Fährt an seinen Platz",
    detail: "Der Arm klappt ein. Bitte Abstand halten.",
  },
};

export const robot: RobotWords = {
  phases,
  state: {
    connecting: { headline: "Einen Moment", detail: "Verbindung zum Roboter wird aufgebaut." },
    unreachable: {
      headline: "Roboter nicht erreichbar",
      detail:
        "Diese Seite versucht es weiter. Prüfen Sie, ob der Roboter Strom hat und ob Sie im Heimnetz sind.",
    },
    outdated: {
      headline: "Diese Seite ist veraltet",
      detail: "Der Roboter hat neue Software bekommen. Laden Sie die Seite neu.",
    },
    offline: {
      headline: "Der Roboter antwortet nicht",
      detail: "Prüfen Sie, ob er Strom hat und sein Kabel fest sitzt. Er meldet sich von selbst zurück.",
    },
    emergency: { headline: "Not-Halt", detail: "Alles steht still." },
    emergencyRemedy: "Vergewissern Sie sich, dass niemand am Stecker ist, und lösen Sie dann den Halt.",
    stopped: {
      headline: "Angehalten",
      detail: "Der Roboter steht still, bis Sie den Halt lösen.",
    },
    stopping: { headline: "Hält an", detail: "Der Roboter kommt zum Stehen." },
    faultUnnamed: {
      headline: "Der Roboter hat ein Problem",
      detail: "Er steht still, bis jemand nachgesehen hat.",
    },
    askPlug: {
      headline: "Ist der Stecker aus dem Auto?",
      detail: "Der Roboter weiß es nicht. Er bewegt sich erst, wenn Sie nachgesehen haben.",
    },
    pluggedIn: {
      headline: "Das Auto ist angesteckt",
      detail: "Stecken Sie es aus, sobald Sie es brauchen.",
    },
    charging: { headline: "Ihr Auto lädt", detail: "Stecken Sie es aus, sobald Sie es brauchen." },
    homing: {
      headline: "Sucht seine Position",
      detail: "Der Roboter bewegt sich langsam. Bitte Abstand halten.",
    },
    moving: { headline: "Der Roboter bewegt sich", detail: "Bitte Abstand halten." },
    movingBy: (name) => `Gesteuert von: ${name}. Bitte Abstand halten.`,
    movingByJob: "Der Roboter arbeitet. Bitte Abstand halten.",
    off: { headline: "Bereit, wenn Sie es sind", detail: "Der Roboter ruht. Er wacht auf, wenn Sie auf Laden drücken." },
    notHomed: {
      headline: "Bereit, wenn Sie es sind",
      detail: "Der Roboter sucht zuerst seine Position, dann steckt er ein.",
    },
    ready: {
      headline: "Bereit zum Laden",
      detail: "Stellen Sie das Auto vor den Roboter und drücken Sie auf Laden.",
    },
    readyAfterCharge: {
      headline: "Fertig geladen",
      detail: "Der Stecker ist aus dem Auto. Sie können losfahren.",
    },
    charged: (energy) => `${energy} geladen. Der Stecker ist heraus, Sie können losfahren.`,
    free: { headline: "Bereit zum Laden", detail: "Der Stecker ist aus dem Auto." },
    queued: { headline: "Gleich geht es los", detail: "Der Roboter beginnt in einem Moment." },
    planned: (start, end) => ({
      headline: "Das Laden ist geplant",
      detail:
        end === null
          ? `Beginn: ${start}. Lassen Sie das Auto stehen.`
          : `Beginn: ${start}, fertig spätestens ${end}. Lassen Sie das Auto stehen.`,
    }),
    paused: {
      headline: "Pause",
      detail: "Der Roboter steht still, und das Auto bekommt keinen Strom, bis Sie fortsetzen.",
    },
    needsPerson: "Der Roboter braucht Sie",
    cancelling: {
      headline: "Bricht ab",
      detail: "Der Roboter fährt an seinen Platz zurück. Bitte Abstand halten.",
    },
    ending: { headline: "Beendet das Laden", detail: "Der Roboter steckt das Auto gleich aus." },
    chargeFailed: "Das Auto konnte nicht geladen werden",
    plugInFailed: "Das Auto konnte nicht angesteckt werden",
    unplugFailed: "Das Auto konnte nicht ausgesteckt werden",
    failedUnnamed: "Der Roboter hat keinen Grund genannt.",
    stillPlugged: "Der Stecker steckt noch im Auto.",
  },
  action: {
    charge: "Laden",
    plan: "Laden planen",
    pause: "Pause",
    goOn: "Fortsetzen",
    giveUp: "Aufgeben",
    again: "Noch einmal versuchen",
    finish: "Beenden und ausstecken",
    unplug: "Ausstecken",
    cancel: "Abbrechen",
    cancelPlan: "Planung aufheben",
    release: "Halt lösen",
    clear: "Störung aufheben",
    plugOut: "Ja, er ist heraus",
    plugIn: "Nein, er steckt noch",
    guide: "Schritt für Schritt",
    wake: "Berühren Sie den Bildschirm, um ihn zu wecken.",
    busy: "Einen Moment…",
    stop: "Stopp",
    stopHint: "Hält jede Bewegung sofort an",
    stopping: "Hält an…",
    emergency: "Not-Halt",
    dismiss: "Verstanden",
    back: "Noch nicht",
  },
  confirmReset: {
    title: "Darf sich der Roboter wieder bewegen?",
    points: ["Niemand ist am Stecker oder am Arm.", "Das Kabel hängt frei.", "Nichts ist im Weg."],
    note: "Nichts bewegt sich, bis Sie den nächsten Knopf drücken.",
    yes: "Ja, lösen",
  },
  confirmPlug: {
    title: "Haben Sie nachgesehen?",
    points: ["Der Stecker ist ganz aus der Ladedose.", "Niemand ist am Stecker oder am Arm."],
    note: "Wenn Sie nicht sicher sind, sehen Sie zuerst nach.",
    yes: "Ja, er ist heraus",
  },
  chooseCar: { title: "Welches Auto?" },
  noCar: {
    code: "no_vehicle",
    title: "Noch kein Auto bekannt",
    detail: "Der Roboter erkennt ein Auto am Etikett neben seiner Ladedose.",
    remedy: "Bitten Sie die Person, die den Roboter betreut, Ihr Auto hinzuzufügen.",
  },
  trouble: {
    remedy: "Was tun:",
    unreachable: {
      code: "unreachable",
      title: "Keine Antwort",
      detail: "Der Roboter hat nicht geantwortet.",
      remedy:
        "Prüfen Sie, ob Sie im Heimnetz sind und der Roboter Strom hat, und versuchen Sie es noch einmal.",
    },
    unexpected: {
      code: "unexpected",
      title: "Das hat nicht geklappt",
      detail: "Diese Seite hat die Antwort nicht verstanden.",
      remedy: "Laden Sie die Seite neu. Wenn es bleibt, starten Sie den Rechner des Roboters neu.",
    },
    stopUnsure: {
      code: "stop_unconfirmed",
      title: "Der Stopp wurde nicht bestätigt",
      detail: "Der Roboter hat auf Stopp nicht geantwortet.",
      remedy: "Drücken Sie den Not-Halt am Roboter oder schalten Sie seinen Strom ab.",
    },
  },
  link: { connecting: "Verbindet", live: "Live", lost: "Verbindet neu", quiet: "Keine Werte" },
  simulator: (speed) => (speed === 1 ? "Simulator" : `Simulator ×${String(speed)}`),
  simulated: {
    car: "Simuliertes Auto",
    camera: "Simulierte Kamera",
    station: "Simulierte Ladestation",
  },
  robot: {
    title: "Roboter",
    mode: "Zustand",
    plug: "Stecker",
    driver: "Verbunden mit",
    drives: "Antriebe",
    drivesOn: "ein",
    drivesOff: "aus",
    tip: "Steckerspitze",
    force: "Kraft",
    socket: "Ladedose gefunden auf",
    simulated: "Nicht echt",
    simulatedParts: { robot: "Roboter", camera: "Kamera", station: "Ladestation" },
    version: "Software",
    enable: "Einschalten",
    disable: "Ausschalten",
    home: "Position suchen",
    technician: "Seite für Techniker",
    control: "Gesteuert von",
    nobody: "niemandem",
    byJob: "laufender Auftrag",
    modes,
    plugStates,
    unknown: "nicht bekannt",
  },
};
