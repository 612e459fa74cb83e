import type { Sentences } from "@/guidance/instruction";
import type { GuidanceWords } from "../types";

const sentences: Sentences = {
  reasons: {
    disabled: [
      "Guida al parcheggio disattivata",
      "È disattivata nelle impostazioni.",
      "Impostare guidance.enabled su true.",
    ],
    robot_offline: [
      "Nessuna guida per ora",
      "Il robot non risponde: non si può sapere dove sia la sua telecamera.",
    ],
    robot_busy: ["Nessuna guida per ora", "Il robot sta lavorando. Non spostare l’auto."],
    robot_not_homed: [
      "Ancora nessuna guida",
      "Il robot non conosce la propria posizione, e quindi nemmeno quella della telecamera.",
      "La ritroverà alla prossima ricarica. Si può anche avviare la ricerca nella scheda «Robot».",
    ],
    robot_not_parked: [
      "Non entrare",
      "Il robot non è al suo posto.",
      "Aspettare che torni al suo posto, oppure riportarlo lì.",
    ],
    plug_held: ["Non spostare l’auto", "La spina è inserita, o potrebbe esserlo."],
    camera_down: [
      "La telecamera non risponde",
      "Senza immagini non si può dire quanto manca.",
      "Controllare il cavo della telecamera. Se necessario, parcheggiare a occhio.",
    ],
    nothing: ["In attesa di un’auto", "L’etichetta accanto alla presa dell’auto non è visibile."],
    too_far: ["Avvicinarsi lentamente", "L’etichetta è ancora troppo lontana per essere letta."],
    too_dirty: [
      "L’etichetta non è leggibile",
      "È sporca, rovinata o in parte coperta.",
      "Fermarsi, pulire l’etichetta e proseguire.",
    ],
    too_dark: ["È troppo buio", "La telecamera non vede quasi nulla.", "Accendere la luce."],
    too_bright: [
      "C’è troppa luce",
      "La telecamera è abbagliata.",
      "Fare ombra alla telecamera, o abbassare i fari.",
    ],
    other_label: [
      "Questa etichetta qui non è conosciuta",
      "Appartiene a un’altra auto, o a un altro robot.",
      "Aggiungere prima l’auto, o stampare la sua etichetta con questo robot.",
    ],
    twice: [
      "Si vedono due etichette",
      "Entrambe dicono di essere la stessa auto.",
      "Togliere la copia.",
    ],
    mirrored: [
      "L’etichetta è riflessa",
      "La telecamera sembra guardare in uno specchio.",
      "Togliere lo specchio.",
    ],
    no_vehicle: [
      "Nessuna auto è ancora conosciuta",
      "Il robot non sa di chi sia l’etichetta che vede.",
      "Aggiungere prima un’auto e stampare la sua etichetta.",
    ],
    hidden: [
      "Stop: l’etichetta è coperta",
      "Un attimo fa si vedeva. Qualcosa la copre.",
      "Togliere ciò che c’è davanti, o pulirla.",
    ],
    left_at_left: [
      "Stop: l’etichetta è uscita dall’immagine",
      "Per il robot la presa è troppo a sinistra.",
      "Tornare un po’ indietro, finché non si rivede.",
    ],
    left_at_right: [
      "Stop: l’etichetta è uscita dall’immagine",
      "Per il robot la presa è troppo a destra.",
      "Tornare un po’ indietro, finché non si rivede.",
    ],
    left_at_top: [
      "Stop: l’etichetta è uscita dall’immagine",
      "Per il robot la presa è troppo in alto.",
      "Tornare un po’ indietro, finché non si rivede.",
    ],
    left_at_bottom: [
      "Stop: l’etichetta è uscita dall’immagine",
      "Per il robot la presa è troppo in basso.",
      "Tornare un po’ indietro, finché non si rivede.",
    ],
    rolls: ["", "Sempre dritto."],
    too_fast: ["", "Rallentare."],
    askew: ["", "L’auto entra storta: raddrizzare."],
    stands: [
      "",
      "Il robot non raggiunge ancora la presa.",
      "Tornare indietro e rientrare più da quel lato.",
    ],
    too_low: [
      "La presa è {distance} troppo in basso",
      "Il robot non può scendere fin lì.",
      "Parcheggiare diversamente non serve: far montare il robot più in basso, o sceglierne un altro.",
    ],
    too_high: [
      "La presa è {distance} troppo in alto",
      "Il robot non può salire fin lì.",
      "Parcheggiare diversamente non serve: far montare il robot più in alto, o sceglierne un altro.",
    ],
    stop: ["Stop", "Frenare ora."],
    good: ["Fermarsi qui", "L’auto è ben posizionata. Si può scendere."],
    good_flawed: [
      "Fermarsi qui",
      "L’auto è ben posizionata, ma la sua etichetta non ha l’aspetto che dovrebbe.",
      "Pulire l’etichetta prima di ricaricare.",
    ],
    thin: ["Appena raggiungibile", "L’auto può restare qui, ma con poco margine."],
    skewed: [
      "L’auto è storta",
      "La presa è ruotata di {skew}°; la spina può seguire al massimo {limit}°.",
      "Controllare che etichetta e presa siano dove erano quando sono state registrate.",
    ],
    skewed_left: [
      "L’auto è storta",
      "La presa è ruotata di {skew}°; la spina può seguire al massimo {limit}°.",
      "Tornare indietro e rientrare più dritti: il muso punta troppo a sinistra.",
    ],
    skewed_right: [
      "L’auto è storta",
      "La presa è ruotata di {skew}°; la spina può seguire al massimo {limit}°.",
      "Tornare indietro e rientrare più dritti: il muso punta troppo a destra.",
    ],
  },
  first: {
    forward: "{distance} avanti",
    back: "{distance} indietro",
    left: "{distance} a sinistra",
    right: "{distance} a destra",
    up: "{distance} troppo in basso",
    down: "{distance} troppo in alto",
  },
  further: {
    forward: "{distance} avanti",
    back: "{distance} indietro",
    left: "{distance} più a sinistra",
    right: "{distance} più a destra",
  },
  and: " e ",
  also: "E {steps}.",
  better: "Meglio: {steps}.",
};

export const guidance: GuidanceWords = {
  title: "Guida al parcheggio",
  show: "Mostra",
  hide: "Nascondi",
  directions: {
    forward: "avanti",
    back: "indietro",
    left: "a sinistra",
    right: "a destra",
    up: "troppo in basso",
    down: "troppo in alto",
  },
  sentences,
  picture: "Visto dall’alto: il robot, i posti che raggiunge e la presa dell’auto.",
  legendReach: "a portata",
  robot: "Robot",
  skew: (degrees, limit) => `storta ${degrees}° su ${limit}°`,
  sigma: (mm) => `presa nota a ± ${mm} mm`,
  simulated: {
    title: "Si guida l’auto simulata",
    driveIn: "Entra",
    brake: "Frena",
    forward: "5 cm avanti",
    back: "5 cm indietro",
    leave: "Esci",
  },
};
