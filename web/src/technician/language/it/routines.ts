/** What each routine is called, wants prepared, and wants to be told. */
import type { CalibrationWords } from "../types";

export const routines: CalibrationWords["routines"] = {
  camera: {
    name: "Calibrare la telecamera",
    purpose: "Focale, centro e distorsione, da immagini della tavola stampata tenuta in mano.",
    prepare: [
      "Stampare la tavola al 100 %, e incollarla su qualcosa di piano e rigido.",
      "Misurare il lato dei suoi quadrati, meglio su cinque di essi, e scriverlo qui.",
      "Lasciare il robot dove si arriva davanti alla telecamera, e mettersi in modo da vedere questa pagina. Non si muove.",
    ],
    start: "Inizia",
    done: "La telecamera è calibrata",
  },
  switches: {
    name: "Finecorsa",
    purpose: "Quanto bene si ripetono: il robot cerca più volte la posizione e guarda dove si trova poi.",
    prepare: [
      "Un’auto con la sua etichetta sta davanti al robot, con il freno tirato.",
      "Il connettore pende libero dal robot.",
      "Da adesso nessuno tocca l’auto, l’etichetta o il robot.",
    ],
    start: "Misura",
    done: "I finecorsa sono misurati",
  },
  play: {
    name: "Gioco dei carrelli",
    purpose: "Porta ogni carrello nello stesso punto dai due lati: la differenza è il gioco della sua cinghia.",
    prepare: [
      "Un’auto con la sua etichetta sta davanti al robot, con il freno tirato.",
      "Il connettore pende libero dal robot.",
      "Da adesso nessuno tocca l’auto, l’etichetta o il robot.",
    ],
    start: "Misura",
    done: "Il gioco è misurato",
  },
  belts: {
    name: "Corsa delle cinghie",
    purpose: "Muove i due carrelli lungo la guida e chiede di quanto si sono mossi davvero.",
    prepare: [
      "Preparare un righello di mezzo metro e una matita.",
      "Il connettore pende libero dal robot. Non serve un’auto.",
      "Il robot si ferma due volte e chiede: segnare dove stanno i carrelli, poi misurare di quanto si sono mossi.",
    ],
    start: "Vai al primo punto",
    done: "Le cinghie sono misurate",
  },
  robot: {
    name: "Misurare il robot",
    purpose: "Gambe, guide, cinghie e rotazione della telecamera, da 25 sguardi a un’etichetta.",
    prepare: [
      "Mettere l’auto in modo che la sua etichetta sia davanti al centro del robot. Va bene anche un’etichetta su una tavola ben ferma.",
      "Misurare prima la corsa delle due cinghie e scrivere qui ciò che diceva il righello. La scala di tutto viene solo da qui.",
      "Da adesso nessuno tocca l’auto, l’etichetta o il robot.",
    ],
    start: "Misura",
    done: "Il robot è misurato",
  },
  force: {
    name: "Forza della slitta",
    purpose: "Attrito della slitta da corse a vuoto e, contro una molla, se la forza mostrata è giusta.",
    prepare: [
      "Il connettore pende libero dal robot. Nessuna auto gli sta vicino davanti.",
      "Tenere le mani lontane dal connettore.",
      "Chi ha una molla di rigidezza nota la tenga pronta: il robot la chiede quando serve.",
    ],
    start: "Inizia le corse",
    done: "La slitta è misurata",
  },
  socket: {
    name: "Insegnare una presa",
    purpose: "Dov’è la presa rispetto alla sua etichetta, con il connettore fino in fondo.",
    prepare: [
      "Misurare prima il robot: un’altra calibrazione del robot sposta ciò che è stato insegnato.",
      "Portare il connettore fino in fondo. Muovere piano a mano e sentire il gioco dai due lati, o far collegare da un lavoro.",
      "Il robot guarda, estrae il connettore lungo il suo asse e guarda di nuovo. L’auto non deve oscillare.",
    ],
    start: "È dentro: insegna",
    done: "La presa è insegnata",
  },
  check: {
    name: "Verificare in nove punti",
    purpose: "Con quanta precisione il robot va dove è mandato, secondo ISO 9283.",
    prepare: [
      "Mettere l’auto in modo che la sua etichetta sia davanti al centro del robot: deve essere nell’immagine da almeno quattro punti.",
      "Il robot va in nove punti, in ciascuno dal basso e dall’alto.",
      "Da adesso nessuno tocca l’auto, l’etichetta o il robot.",
    ],
    start: "Verifica",
    done: "La verifica è finita",
  },
};

export const fields: CalibrationWords["fields"] = {
  leftSent: "Carrello sinistro: richiesto, mm",
  leftWent: "fatto davvero, mm",
  rightSent: "Carrello destro: richiesto, mm",
  rightWent: "fatto davvero, mm",
  label: "Lato dell’etichetta misurato a ± mm",
  approaches: "Arrivi in ogni punto, da ogni lato",
  homings: "Quante volte cerca la posizione",
  reversals: "Arrivi con ogni carrello, da ogni lato",
  distance: "Distanza, mm",
  reading: "Righello letto a ± mm",
  strokes: "Corse, avanti e indietro",
  stroke: "Lunghezza di una corsa, mm",
  spring: "Rigidezza della molla, N/mm",
  springKnown: "Rigidezza nota a ± %",
  square: "Lato di un quadrato, mm",
};

export const fieldHints: CalibrationWords["fieldHints"] = {
  belts: "Lasciare vuoto ciò che la misura delle cinghie ha dato e che è in uso. Senza l’uno né l’altro, la scala si conosce solo a un quarto di percento.",
  spring: "Senza molla lasciare vuota la rigidezza: l’attrito si misura comunque.",
};
