/** What the server says in English about calibration. */
import type { CalibrationWords } from "../types";

const the = (side?: string): string => (side === "left" ? "linke" : "rechte");

export const doing: CalibrationWords["doing"] = {
  ready: "Der Roboter wird bereit gemacht.",
  search: "Die Marke wird gesucht.",
  wiring: "Es wird geprüft, ob jeder Motor seinen Schlitten bewegt.",
  looks: "Die Marke wird von vielen Stellen aus angesehen.",
  unmoved: "Es wird nachgesehen, ob die Marke ist, wo sie war.",
  solve: "Es wird ausgerechnet, wie der Roboter gebaut ist.",
  sides: "Jede Stelle wird von beiden Seiten angefahren.",
  mated: "Die Marke wird mit dem Stecker in der Dose angesehen.",
  draw: "Der Stecker wird herausgezogen.",
  back: "Die Marke wird mit zurückgezogenem Stecker angesehen.",
  kept: "Die Kalibrierung ist fertig. Noch benutzt sie niemand.",
  checked: "Die Prüfung ist fertig.",
  board: "Die Tafel wird gesucht.",
  camera: "Die Kamera wird aus den Bildern ausgerechnet.",
  first: "Der Roboter fährt an die erste Stelle.",
  second: "Der Roboter fährt an die zweite Stelle.",
  rule: "Es fehlt, was der Maßstab sagt.",
  homing: (done, total) => `Die Position wird gesucht, ${done} von ${total}.`,
  play: (side, from) => `Der ${the(side)} Schlitten kommt von ${from === "below" ? "unten" : "oben"} an dieselbe Stelle.`,
  freely: (done, total) => `Der Schieber fährt frei, ${done} von ${total}.`,
  spring: (done, total) => `Die Feder wird gedrückt, ${done} von ${total}.`,
};

export const remarks: CalibrationWords["remarks"] = {
  missed: (a) => `Zurückgehaltene Stellen werden um ${a} mm verfehlt: hat sich die Marke bewegt, ist ein Riemen lose, klemmt ein Schlitten?`,
  missedUsable: (a, b) => `Zurückgehaltene Stellen werden um ${a} mm verfehlt; ein guter Roboter schafft ${b} mm. Spannen Sie die Riemen und wiederholen Sie.`,
  worse: (a, b) => `Die benutzte Kalibrierung verfehlt dieselben Stellen nur um ${a} mm, diese um ${b} mm.`,
  outliers: (a) => `${a} % der Blicke passen nicht zu den anderen: währenddessen hat sich etwas bewegt.`,
  hidden: () => "Der Stecker hat die Marke verdeckt: niemand sah, ob sich das Auto beim Herausziehen bewegte.",
  apart: (a) => `Die Endschalter der beiden Schlitten sind ${a} mm weiter auseinander als bei der benutzten Kalibrierung: einer hat sich verstellt.`,
  nearer: (a) => `Die Endschalter der beiden Schlitten sind ${a} mm näher beisammen als bei der benutzten Kalibrierung: einer hat sich verstellt.`,
  far: (what, difference) => `Anders als gezeichnet (${what}): ${difference}. Messen Sie von Hand nach, bevor Sie dem trauen.`,
  unseen: (what) => `${what}: darüber sagen die Blicke wenig; was vorher bekannt war, bleibt.`,
  beltsOnly: () => "Nur die Riemen wurden gemessen. Vermessen Sie auch den Roboter: Beine und Schienen sind wie gezeichnet.",
  loose: (side, a) => `Der ${the(side)} Endschalter schließt nur auf ${a} mm genau: befestigen Sie ihn, und sehen Sie nach dem Spiel seines Hebels.`,
  play: (side, a) => `Der ${the(side)} Schlitten hat ${a} mm Spiel: spannen Sie seinen Riemen, und sehen Sie nach Rolle und Getriebe.`,
  lag: (side, a) => `Der ${the(side)} Schlitten läuft ${a} mm nach, während er fährt.`,
  friction: (a) => `Der Schieber braucht ${a} N, um frei zu laufen: reinigen und fetten Sie seine Spindel.`,
  offset: (a) => `Ohne Kraft zeigt der Motorstrom ${a} N: etwas zieht am Schieber, etwa das Kabel.`,
  scale: (a) => `Die gezeigte Kraft ist das ${a}-Fache der wahren: nehmen Sie dies in Gebrauch, oder berichtigen Sie in den Einstellungen der Platine die Kraft des Motors für seinen Strom und messen Sie noch einmal.`,
  lens: () => "Die Werte der Kamera sind die aus ihrem Datenblatt, und danach wird gezielt: Kalibrieren Sie die Kamera mit der Tafel, dann wiederholen Sie.",
  edges: (a) => `Am Rand des Arbeitsraums kann der Stecker noch ${a} mm danebenliegen: messen Sie die Riemen über 400 mm und die Marke mit der Schieblehre, stellen Sie die Marke nahe an die Mitte des Arbeitsraums, und wiederholen Sie.`,
  corners: (a) => `Die Ecken liegen im Mittel ${a} px daneben: ist die Tafel eben, der Fokus fest, und nichts unscharf?`,
  focal: (a) => `Die Brennweite ist nur auf ${a} % sicher: nehmen Sie mehr Bilder schräg und aus verschiedenen Abständen auf.`,
  centre: (a) => `Die Mitte ist nur auf ${a} px sicher: drehen Sie die Tafel in einigen Bildern um ein Viertel, und kippen Sie sie.`,
  cover: (a) => `Die Tafel war in ${a} % des Bildes: halten Sie sie dorthin, wo sie noch nicht war.`,
  angle: (a, b) => `Nur ${a} Bilder zeigen die Tafel schräg; es sollen ${b} oder mehr sein.`,
  held: (a) => `Zurückgehaltene Bilder passen schlechter (${a} px): nehmen Sie mehr Bilder auf.`,
  leftOut: (a) => `${a} Bilder mussten weggelassen werden: hat sich die Tafel gebogen oder der Fokus verstellt?`,
  places: (a, b) => `AP + RP ist bis zu ${a} mm; verlangt sind ${b} mm.`,
  mostPlay: () => "Das meiste davon ist Spiel: spannen Sie die Riemen, und prüfen Sie noch einmal.",
  off: () => "Die Stellen liegen daneben, aber immer gleich: vermessen Sie den Roboter, und prüfen Sie noch einmal.",
  unsteady: () => "Die Stellen wiederholen sich nicht: sehen Sie nach, ob ein Schlitten klemmt.",
  unknowns: {
    left_leg: "Länge des linken Beins",
    right_leg: "Länge des rechten Beins",
    right_foot_x: "Abstand der beiden Schlitten",
    right_foot_y: "Höhe des rechten Schlittens über dem linken",
    half_skew: "Winkel zwischen den Schienen",
    left_scale: "Weg des linken Riemens",
    right_scale: "Weg des rechten Riemens",
    camera_x: "Neigung der Kamera",
    camera_y: "Schwenk der Kamera",
    camera_z: "Rollen der Kamera",
    label_x: "Ort der Marke entlang der Schiene",
    label_y: "Höhe der Marke",
    label_z: "Abstand der Marke",
    label_ratio: "Größe der Marke",
  },
};

export const questions: CalibrationWords["questions"] = {
  camera_enough: () => "Hören Sie auf, wann Sie wollen: was da ist, lässt sich jetzt ausrechnen.",
  belts_marked: () => "Zeichnen Sie an der Schiene an, wo beide Schlitten stehen, und bestätigen Sie dann.",
  belts_left: () => "Wie weit ist der linke Schlitten von seinem Strich weg?",
  belts_right: () => "Wie weit ist der rechte Schlitten von seinem Strich weg?",
  force_clear: (a) => `Auf ${a} mm vor dem Stecker darf nichts stehen. Bestätigen Sie dann.`,
  force_spring: (a) => `Stellen Sie die Feder mit ${a} N/mm gerade vor den Stecker, gegen etwas Festes, und bestätigen Sie dann. Der Stecker drückt sie zusammen.`,
};

export const hints: CalibrationWords["hints"] = {
  belts_drifted: [
    "Der Roboter ist weiter verschoben als nachgewiesen",
    (moved, proven, side, stretch) =>
      `Seit er vermessen ist, haben sich Stellen um bis zu ${moved} mm verschoben; ${proven} mm waren nachgewiesen. Der ${the(side)} Riemen läuft ${stretch} % anders als damals. Sehen Sie nach seiner Spannung, dann vermessen Sie den Roboter.`,
  ],
  looks_misfit: [
    "Was Aufträge sehen, passt nicht zur Kalibrierung",
    (count) =>
      `In ${count} Aufträgen nacheinander schien sich die Marke zu bewegen. Daraus wurde nichts gelernt. Sehen Sie nach, ob Riemen, Endschalter und Kamera fest sitzen, dann vermessen Sie den Roboter.`,
  ],
  plug_heavy: [
    "Der Stecker geht schwerer hinein als früher",
    (depth, count, mean, lower, upper) =>
      `In ${depth} mm Tiefe brauchte er die letzten ${count} Male ${mean} N; üblich waren ${lower} bis ${upper} N. Reinigen Sie Stecker und Dose, und suchen Sie nach verbogenen Kontakten.`,
  ],
  plug_light: [
    "Der Stecker geht leichter hinein als früher",
    (depth, count, mean, lower, upper) =>
      `In ${depth} mm Tiefe brauchte er die letzten ${count} Male ${mean} N; üblich waren ${lower} bis ${upper} N. Seine Kontakte sind vielleicht abgenutzt: lassen Sie Stecker und Dose prüfen.`,
  ],
  slide_heavy: [
    "Der Schieber läuft schwerer als früher",
    (now, usual) => `Vor der Dose braucht er ${now} N; üblich waren ${usual} N. Reinigen und fetten Sie seine Spindel.`,
  ],
  socket_off: [
    "Die Dose ist nicht, wo ihre Marke sagt",
    (right, up, car) =>
      `Die letzten Stecker gingen ${right} mm weiter rechts und ${up} mm weiter oben hinein. Sehen Sie nach, ob sich die Marke von ${car} gelöst hat, dann lehren Sie die Dose neu.`,
  ],
};
