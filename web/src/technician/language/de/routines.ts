/** What each routine is called, wants prepared, and wants to be told. */
import type { CalibrationWords } from "../types";

export const routines: CalibrationWords["routines"] = {
  camera: {
    name: "Kamera kalibrieren",
    purpose: "Brennweite, Mitte und Verzeichnung, aus Bildern der gedruckten Tafel in Ihren Händen.",
    prepare: [
      "Drucken Sie die Tafel in Originalgröße, und kleben Sie sie auf etwas Ebenes und Steifes.",
      "Messen Sie die Seite ihrer Quadrate, am besten über fünf davon, und tragen Sie sie hier ein.",
      "Lassen Sie den Roboter dort stehen, wo Sie vor die Kamera kommen, und stellen Sie sich so, dass Sie diese Seite sehen. Er bewegt sich nicht.",
    ],
    start: "Hinsehen lassen",
    done: "Die Kamera ist kalibriert",
  },
  switches: {
    name: "Endschalter",
    purpose: "Wie gut sie wiederholen: sucht mehrmals die Position und schaut, wo der Roboter dann steht.",
    prepare: [
      "Ein Auto mit seiner Marke steht vor dem Roboter, die Bremse ist angezogen.",
      "Der Stecker hängt frei am Roboter.",
      "Ab jetzt berührt niemand Auto, Marke oder Roboter.",
    ],
    start: "Messen",
    done: "Die Endschalter sind gemessen",
  },
  play: {
    name: "Spiel der Schlitten",
    purpose: "Bringt jeden Schlitten von beiden Seiten an eine Stelle: was sich unterscheidet, ist das Spiel seines Riemens.",
    prepare: [
      "Ein Auto mit seiner Marke steht vor dem Roboter, die Bremse ist angezogen.",
      "Der Stecker hängt frei am Roboter.",
      "Ab jetzt berührt niemand Auto, Marke oder Roboter.",
    ],
    start: "Messen",
    done: "Das Spiel ist gemessen",
  },
  belts: {
    name: "Weg der Riemen",
    purpose: "Fährt beide Schlitten die Schiene entlang und fragt, wie weit sie wirklich kamen.",
    prepare: [
      "Legen Sie einen Maßstab von einem halben Meter und einen Bleistift bereit.",
      "Der Stecker hängt frei am Roboter. Ein Auto braucht es nicht.",
      "Der Roboter hält zweimal und fragt: zeichnen Sie an, wo die Schlitten stehen, und messen Sie dann, wie weit sie gekommen sind.",
    ],
    start: "An die erste Stelle",
    done: "Die Riemen sind gemessen",
  },
  robot: {
    name: "Roboter vermessen",
    purpose: "Beine, Schienen, Riemen und die Drehung der Kamera, aus 25 Blicken auf eine Marke.",
    prepare: [
      "Stellen Sie das Auto so hin, dass seine Marke vor der Mitte des Roboters ist. Eine Marke auf einem fest stehenden Brett geht auch.",
      "Messen Sie zuerst den Weg beider Riemen und tragen Sie hier ein, was der Maßstab sagte. Nur daher kommt der Maßstab von allem.",
      "Ab jetzt berührt niemand Auto, Marke oder Roboter.",
    ],
    start: "Vermessen",
    done: "Der Roboter ist vermessen",
  },
  force: {
    name: "Kraft des Schiebers",
    purpose: "Reibung des Schiebers aus Hüben in der Luft und, gegen eine Feder, ob die gezeigte Kraft stimmt.",
    prepare: [
      "Der Stecker hängt frei am Roboter. Kein Auto steht nah davor.",
      "Halten Sie die Hände vom Stecker fern.",
      "Haben Sie eine Feder mit bekannter Federrate, dann fragt der Roboter danach, sobald er sie braucht.",
    ],
    start: "Mit den Hüben beginnen",
    done: "Der Schieber ist gemessen",
  },
  socket: {
    name: "Dose lehren",
    purpose: "Wo die Dose neben ihrer Marke ist, mit ganz eingestecktem Stecker.",
    prepare: [
      "Vermessen Sie zuerst den Roboter: eine andere Kalibrierung des Roboters verschiebt das Gelehrte.",
      "Bringen Sie den Stecker ganz hinein. Fahren Sie langsam von Hand und fühlen Sie das Spiel auf beiden Seiten, oder lassen Sie einen Auftrag einstecken.",
      "Der Roboter schaut, zieht den Stecker entlang seiner Achse heraus und schaut noch einmal. Das Auto darf nicht wackeln.",
    ],
    start: "Der Stecker ist drin: lehren",
    done: "Die Dose ist gelehrt",
  },
  check: {
    name: "An neun Stellen prüfen",
    purpose: "Wie genau der Roboter dorthin kommt, wohin er soll, nach ISO 9283.",
    prepare: [
      "Stellen Sie das Auto so hin, dass seine Marke vor der Mitte des Roboters ist: sie muss von mindestens vier Stellen aus im Bild sein.",
      "Der Roboter fährt neun Stellen an, jede von unten und von oben.",
      "Ab jetzt berührt niemand Auto, Marke oder Roboter.",
    ],
    start: "Prüfen",
    done: "Die Prüfung ist fertig",
  },
};

export const fields: CalibrationWords["fields"] = {
  leftSent: "Linker Schlitten: Soll, mm",
  leftWent: "wirklich, mm",
  rightSent: "Rechter Schlitten: Soll, mm",
  rightWent: "wirklich, mm",
  label: "Seite der Marke gemessen auf ± mm",
  approaches: "Anfahrten jeder Stelle, von jeder Seite",
  homings: "Wie oft die Position gesucht wird",
  reversals: "Anfahrten mit jedem Schlitten, von jeder Seite",
  distance: "Strecke, mm",
  reading: "Maßstab abgelesen auf ± mm",
  strokes: "Hübe, hin und zurück",
  stroke: "Länge eines Hubs, mm",
  spring: "Federrate, N/mm",
  springKnown: "Federrate bekannt auf ± %",
  square: "Seite eines Quadrats, mm",
};

export const fieldHints: CalibrationWords["fieldHints"] = {
  belts: "Lassen Sie leer, was die Messung der Riemen ergeben hat und in Gebrauch ist. Ohne beides ist der Maßstab nur auf ein viertel Prozent bekannt.",
  spring: "Ohne Feder lassen Sie die Federrate leer: die Reibung wird trotzdem gemessen.",
};
