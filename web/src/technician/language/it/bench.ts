import type { JogAxis, RobotMode } from "@/api/wire";
import { formatNumber } from "@/format";
import type { Direction } from "../../jog/axes";
import type { BenchWords } from "../types";
import { problems } from "./problems";

const not: Record<Exclude<RobotMode, "ready" | "moving">, string> = {
  offline: "Il robot non risponde.",
  off: "I motori sono spenti: accenderli prima.",
  not_homed: "La posizione è sconosciuta: cercarla prima.",
  homing: "Il robot cerca la sua posizione.",
  stopping: "Il robot si sta fermando.",
  stopped: "Qualcuno ha premuto Stop: sbloccarlo prima.",
  emergency_stop: "Arresto di emergenza: sbloccarlo prima.",
  fault: "C’è un guasto: sbloccarlo prima.",
};

const ways: Record<JogAxis, Record<Direction, string>> = {
  x: { [-1]: "Indietro lungo la guida", 1: "Avanti lungo la guida" },
  y: { [-1]: "Giù", 1: "Su" },
  insertion: { [-1]: "Via dall’auto", 1: "Verso l’auto" },
  rho1: { [-1]: "Carrello sinistro indietro", 1: "Carrello sinistro avanti" },
  rho2: { [-1]: "Carrello destro indietro", 1: "Carrello destro avanti" },
  rho3: { [-1]: "Slitta dentro", 1: "Slitta fuori" },
};

export const bench: BenchWords = {
  title: "Tecnica",
  panel: {
    loading: "Caricamento…",
    away: "Questa parte non è stata caricata. Ricaricare la pagina.",
  },
  robot: {
    title: "Robot",
    enable: "Accendi i motori",
    disable: "Spegni i motori",
    find: "Cerca la posizione",
    release: "Sblocca",
    control: "Ai comandi",
    nobody: "nessuno",
  },
  jog: {
    title: "Muovere a mano",
    frame: "Direzioni",
    frames: { base: "Connettore", joints: "Assi" },
    amount: "Di quanto, mm",
    hold: "Premuto",
    speed: "Velocità, mm/s",
    axes: { x: "x", y: "y", insertion: "Inserimento", rho1: "ρ1", rho2: "ρ2", rho3: "ρ3" },
    ways,
    keys: "Tasti: frecce e Pag su, Pag giù finché questo riquadro è attivo.",
    gamepad: "Gamepad: tenere L1 e spingere una leva. Lasciare L1 ferma.",
    left: (way_mm) => (way_mm === 0 ? "fine" : `${formatNumber(way_mm, 0)} mm`),
    notAllowed: "È permesso guardare. Qui muovono il robot solo i tecnici e i proprietari.",
    notLive: "La pagina non ha valori recenti.",
    busy: "Il robot si muove.",
    controlled: (name) => `Ai comandi: ${name}.`,
    onlyOut: "Il connettore può essere in una presa: è aperta solo l’uscita.",
    ready: "Pronto. Il robot si muove solo finché un pulsante è premuto.",
    readyStep: "Pronto. Ogni pressione fa un passo.",
    not,
    noAnswer: {
      code: "no_answer",
      title: "Nessuna risposta",
      detail: "Il robot non ha risposto, perciò il movimento è stato fermato.",
      remedy: "Controllare la connessione e riprovare.",
    },
  },
  values: {
    title: "Valori",
    joint: "Asse",
    commanded: "Richiesto",
    measured: "Misurato",
    error: "Errore",
    tip: "Punta del connettore",
    force: "Forza",
    age: "Età",
    unit: "mm",
    unknown: "–",
    joints: { rho1: "ρ1", rho2: "ρ2", rho3: "ρ3" },
  },
  plots: {
    title: "Nel tempo",
    loading: "Caricamento delle curve…",
    joints: "Assi, mm",
    errors: "Errore di inseguimento, mm",
    force: "Forza, N",
    forceWay: "Forza lungo la corsa di ρ3, N",
    out: "andata",
    back: "ritorno",
    hold: "Ferma",
    go: "Continua",
  },
  problems,
  stop: {
    protective: "Stop",
    emergency: "Arresto di emergenza",
    hint: "Ferma subito ogni movimento. Finché il robot si muove, lo fa anche la barra spaziatrice.",
  },
};
