import type { JogAxis, RobotMode } from "@/api/wire";
import { formatNumber } from "@/format";
import type { Direction } from "../../jog/axes";
import type { BenchWords } from "../types";
import { problems } from "./problems";

const not: Record<Exclude<RobotMode, "ready" | "moving">, string> = {
  offline: "Der Roboter antwortet nicht.",
  off: "Die Antriebe sind aus: zuerst einschalten.",
  not_homed: "Die Position ist unbekannt: zuerst suchen.",
  homing: "Der Roboter sucht seine Position.",
  stopping: "Der Roboter kommt zum Stehen.",
  stopped: "Jemand hat Stopp gedrückt: zuerst freigeben.",
  emergency_stop: "Not-Halt: zuerst freigeben.",
  fault: "Es gibt eine Störung: zuerst freigeben.",
};

const ways: Record<JogAxis, Record<Direction, string>> = {
  x: { [-1]: "Zurück entlang der Schiene", 1: "Vor entlang der Schiene" },
  y: { [-1]: "Abwärts", 1: "Aufwärts" },
  insertion: { [-1]: "Weg vom Auto", 1: "Zum Auto" },
  rho1: { [-1]: "Linker Schlitten zurück", 1: "Linker Schlitten vor" },
  rho2: { [-1]: "Rechter Schlitten zurück", 1: "Rechter Schlitten vor" },
  rho3: { [-1]: "Schieber ein", 1: "Schieber aus" },
};

export const bench: BenchWords = {
  title: "Technik",
  panel: {
    loading: "Wird geladen …",
    away: "Dieser Teil konnte nicht geladen werden. Laden Sie die Seite neu.",
  },
  robot: {
    title: "Roboter",
    enable: "Antriebe ein",
    disable: "Antriebe aus",
    find: "Position suchen",
    release: "Freigeben",
    control: "Steuert gerade",
    nobody: "niemand",
  },
  jog: {
    title: "Von Hand bewegen",
    frame: "Richtungen",
    frames: { base: "Stecker", joints: "Achsen" },
    amount: "Wie weit, mm",
    hold: "Gehalten",
    speed: "Tempo, mm/s",
    axes: { x: "x", y: "y", insertion: "Stecken", rho1: "ρ1", rho2: "ρ2", rho3: "ρ3" },
    ways,
    keys: "Tasten: Pfeile und Bild auf, Bild ab, solange dieses Feld den Fokus hat.",
    gamepad: "Gamepad: L1 halten und einen Stick drücken. L1 loslassen hält an.",
    left: (way_mm) => (way_mm === 0 ? "Ende" : `${formatNumber(way_mm, 0)} mm`),
    notAllowed: "Sie dürfen zusehen. Hier bewegen nur Technik und Eigentümer den Roboter.",
    notLive: "Die Seite hat keine frischen Werte.",
    busy: "Der Roboter bewegt sich.",
    controlled: (name) => `${name} steuert gerade.`,
    onlyOut: "Der Stecker kann in einer Dose stecken: nur der Weg heraus ist offen.",
    ready: "Bereit. Der Roboter bewegt sich nur, solange Sie eine Taste halten.",
    readyStep: "Bereit. Jeder Druck bewegt einen Schritt weit.",
    not,
    noAnswer: {
      code: "no_answer",
      title: "Keine Antwort",
      detail: "Der Roboter hat nicht geantwortet, darum wurde die Bewegung beendet.",
      remedy: "Prüfen Sie die Verbindung und versuchen Sie es erneut.",
    },
  },
  values: {
    title: "Werte",
    joint: "Achse",
    commanded: "Soll",
    measured: "Ist",
    error: "Schleppfehler",
    tip: "Steckerspitze",
    force: "Kraft",
    age: "Alter",
    unit: "mm",
    unknown: "–",
    joints: { rho1: "ρ1", rho2: "ρ2", rho3: "ρ3" },
  },
  plots: {
    title: "Verlauf",
    loading: "Die Kurven werden geladen …",
    joints: "Achsen, mm",
    errors: "Schleppfehler, mm",
    force: "Kraft, N",
    forceWay: "Kraft über dem Weg von ρ3, N",
    out: "hin",
    back: "zurück",
    hold: "Anhalten",
    go: "Weiter",
  },
  problems,
  stop: {
    protective: "Stopp",
    emergency: "Not-Halt",
    hint: "Hält sofort jede Bewegung an. Solange sich der Roboter bewegt, tut es auch die Leertaste.",
  },
};
