/** What the server says in English about calibration. */
import type { CalibrationWords } from "../types";

const masculine = (side?: string): string => (side === "left" ? "sinistro" : "destro");
const feminine = (side?: string): string => (side === "left" ? "sinistra" : "destra");

export const doing: CalibrationWords["doing"] = {
  ready: "Il robot si prepara.",
  search: "Si cerca l’etichetta.",
  wiring: "Si controlla che ogni motore muova il suo carrello.",
  looks: "Si guarda l’etichetta da molti punti.",
  unmoved: "Si controlla che l’etichetta sia dov’era.",
  solve: "Si calcola come è costruito il robot.",
  sides: "Si arriva in ogni punto dai due lati.",
  mated: "Si guarda l’etichetta con il connettore nella presa.",
  draw: "Si estrae il connettore.",
  back: "Si guarda l’etichetta con il connettore ritirato.",
  kept: "La calibrazione è finita. Nessuno la usa ancora.",
  checked: "La verifica è finita.",
  board: "Si cerca la tavola.",
  camera: "Si calcola la telecamera dalle immagini.",
  first: "Il robot va al primo punto.",
  second: "Il robot va al secondo punto.",
  rule: "Manca ciò che dice il righello.",
  homing: (done, total) => `Si cerca la posizione, ${done} di ${total}.`,
  play: (side, from) => `Il carrello ${masculine(side)} torna nello stesso punto ${from === "below" ? "dal basso" : "dall’alto"}.`,
  freely: (done, total) => `La slitta si muove a vuoto, ${done} di ${total}.`,
  spring: (done, total) => `Si preme la molla, ${done} di ${total}.`,
};

export const remarks: CalibrationWords["remarks"] = {
  missed: (a) => `I punti tenuti da parte sono mancati di ${a} mm: l’etichetta si è mossa, una cinghia è lenta, un carrello si blocca?`,
  missedUsable: (a, b) => `I punti tenuti da parte sono mancati di ${a} mm; un buon robot arriva a ${b} mm. Tendere le cinghie e ripetere.`,
  worse: (a, b) => `La calibrazione in uso manca gli stessi punti solo di ${a} mm, questa di ${b} mm.`,
  outliers: (a) => `Il ${a} % degli sguardi non va con gli altri: nel frattempo qualcosa si è mosso.`,
  hidden: () => "Il connettore nascondeva l’etichetta: nessuno ha visto se l’auto si è mossa all’estrazione.",
  apart: (a) => `I finecorsa dei due carrelli sono ${a} mm più lontani che con la calibrazione in uso: uno si è spostato.`,
  nearer: (a) => `I finecorsa dei due carrelli sono ${a} mm più vicini che con la calibrazione in uso: uno si è spostato.`,
  far: (what, difference) => `Lontano dal disegno (${what}): ${difference}. Misurare a mano prima di fidarsi.`,
  unseen: (what) => `${what}: gli sguardi ne dicono poco, e resta ciò che si sapeva prima.`,
  beltsOnly: () => "Sono state misurate solo le cinghie. Misurare anche il robot: gambe e guide sono come da disegno.",
  loose: (side, a) => `Il finecorsa ${masculine(side)} chiude solo entro ${a} mm: fissarlo, e guardare il gioco della sua leva.`,
  play: (side, a) => `Il carrello ${masculine(side)} ha ${a} mm di gioco: tendere la sua cinghia, e guardare puleggia e ingranaggio.`,
  lag: (side, a) => `Il carrello ${masculine(side)} è in ritardo di ${a} mm mentre si muove.`,
  friction: (a) => `La slitta richiede ${a} N per muoversi a vuoto: pulire e ingrassare la sua vite.`,
  offset: (a) => `Senza alcuna forza la corrente del motore mostra ${a} N: qualcosa tira la slitta, per esempio il cavo.`,
  scale: (a) => `La forza mostrata è ${a} volte quella vera: mettere in vigore questa versione, oppure correggere la forza del motore per la sua corrente nelle impostazioni della scheda e ripetere.`,
  lens: () => "I valori della telecamera sono quelli della scheda tecnica, e il robot mira secondo quelli: calibrare la telecamera con la tavola, poi ripetere.",
  edges: (a) => `Ai bordi dell’area di lavoro il connettore può ancora sbagliare di ${a} mm: misurare le cinghie su 400 mm e l’etichetta con il calibro, mettere l’etichetta vicino al centro dell’area di lavoro, e ripetere.`,
  corners: (a) => `Gli angoli sbagliano in media di ${a} px: la tavola è piana, il fuoco fisso, e nulla sfocato?`,
  focal: (a) => `La focale è sicura solo al ${a} %: prendere più immagini di sbieco e a distanze diverse.`,
  centre: (a) => `Il centro è sicuro solo a ${a} px: in alcune immagini ruotare la tavola di un quarto di giro, e inclinarla.`,
  cover: (a) => `La tavola è stata nel ${a} % dell’immagine: tenerla dove non era ancora.`,
  angle: (a, b) => `Solo ${a} immagini mostrano la tavola di sbieco; ne servono ${b} o più.`,
  held: (a) => `Le immagini tenute da parte vanno peggio (${a} px): prendere più immagini.`,
  leftOut: (a) => `${a} immagini si sono dovute escludere: la tavola si è piegata o il fuoco si è spostato?`,
  places: (a, b) => `AP + RP arriva a ${a} mm; ne sono richiesti ${b}.`,
  mostPlay: () => "È soprattutto gioco: tendere le cinghie, poi verificare di nuovo.",
  off: () => "I punti sono spostati, ma si ripetono: misurare il robot, poi verificare di nuovo.",
  unsteady: () => "I punti non si ripetono: guardare se un carrello si blocca.",
  unknowns: {
    left_leg: "lunghezza della gamba sinistra",
    right_leg: "lunghezza della gamba destra",
    right_foot_x: "distanza dei due carrelli",
    right_foot_y: "altezza del carrello destro sul sinistro",
    half_skew: "angolo tra le due guide",
    left_scale: "corsa della cinghia sinistra",
    right_scale: "corsa della cinghia destra",
    camera_x: "inclinazione della telecamera",
    camera_y: "orientamento della telecamera",
    camera_z: "rollio della telecamera",
    label_x: "posto dell’etichetta lungo la guida",
    label_y: "altezza dell’etichetta",
    label_z: "distanza dell’etichetta",
    label_ratio: "misura dell’etichetta",
  },
};

export const questions: CalibrationWords["questions"] = {
  camera_enough: () => "Smettere quando si vuole: ciò che c’è si può calcolare adesso.",
  belts_marked: () => "Segnare sulla guida dove stanno i due carrelli, poi confermare.",
  belts_left: () => "Di quanto si è allontanato il carrello sinistro dal suo segno?",
  belts_right: () => "Di quanto si è allontanato il carrello destro dal suo segno?",
  force_clear: (a) => `Non lasciare nulla entro ${a} mm davanti al connettore, poi confermare.`,
  force_spring: (a) => `Mettere la molla da ${a} N/mm diritta davanti al connettore, contro qualcosa di fermo, poi confermare. Il connettore la comprimerà.`,
};

export const hints: CalibrationWords["hints"] = {
  belts_drifted: [
    "Il robot si è spostato più di quanto era provato",
    (moved, proven, side, stretch) =>
      `Da quando è misurato, i punti si sono spostati fino a ${moved} mm; ${proven} mm erano provati. La cinghia ${feminine(side)} fa ${stretch} % rispetto ad allora. Guardare la sua tensione, poi misurare il robot.`,
  ],
  looks_misfit: [
    "Ciò che vedono i lavori non va con la calibrazione",
    (count) =>
      `In ${count} lavori di seguito l’etichetta è sembrata muoversi. Non se ne è imparato nulla. Guardare se cinghie, finecorsa e telecamera sono ben fissi, poi misurare il robot.`,
  ],
  plug_heavy: [
    "Il connettore entra con più fatica di prima",
    (depth, count, mean, lower, upper) =>
      `A ${depth} mm di profondità le ultime ${count} volte ha richiesto ${mean} N; di solito da ${lower} a ${upper} N. Pulire connettore e presa, e cercare contatti piegati.`,
  ],
  plug_light: [
    "Il connettore entra con meno fatica di prima",
    (depth, count, mean, lower, upper) =>
      `A ${depth} mm di profondità le ultime ${count} volte ha richiesto ${mean} N; di solito da ${lower} a ${upper} N. I suoi contatti possono essere consumati: far controllare connettore e presa.`,
  ],
  slide_heavy: [
    "La slitta si muove con più fatica di prima",
    (now, usual) => `Davanti alla presa richiede ${now} N; di solito ${usual} N. Pulire e ingrassare la sua vite.`,
  ],
  socket_off: [
    "La presa non è dove dice la sua etichetta",
    (right, up, car) =>
      `Gli ultimi connettori sono entrati ${right} mm più a destra e ${up} mm più in alto. Guardare se l’etichetta di ${car} si è staccata, poi insegnare di nuovo la presa.`,
  ],
};
