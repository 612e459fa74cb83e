import type { Sentences } from "@/guidance/instruction";
import type { GuidanceWords } from "../types";

const sentences: Sentences = {
  reasons: {
    disabled: ["Einparkhilfe aus", "Sie ist in den Einstellungen abgeschaltet.", "Setzen Sie guidance.enabled auf true."],
    robot_offline: ["Keine Einparkhilfe", "Der Roboter antwortet nicht, also weiß niemand, wo seine Kamera ist."],
    robot_busy: ["Keine Einparkhilfe", "Der Roboter arbeitet gerade. Bitte das Auto nicht bewegen."],
    robot_not_homed: [
      "Noch keine Einparkhilfe",
      "Der Roboter kennt seine eigene Position nicht und damit auch nicht die seiner Kamera.",
      "Er findet sie beim nächsten Laden von selbst. Sie können das auch in der Karte „Roboter“ starten.",
    ],
    robot_not_parked: [
      "Nicht einfahren",
      "Der Roboter steht nicht an seinem Platz.",
      "Warten Sie, bis er geparkt hat, oder bewegen Sie ihn dorthin.",
    ],
    plug_held: ["Auto nicht bewegen", "Der Stecker steckt darin, oder vielleicht."],
    camera_down: [
      "Die Kamera antwortet nicht",
      "Ohne Bilder kann niemand sagen, wie weit es noch ist.",
      "Prüfen Sie das Kabel der Kamera. Parken Sie zur Not nach Augenmaß.",
    ],
    nothing: ["Warte auf ein Auto", "Das Etikett neben der Ladedose ist nicht im Bild."],
    too_far: ["Langsam näher kommen", "Das Etikett ist noch zu weit weg, um es zu lesen."],
    too_dirty: [
      "Das Etikett ist nicht lesbar",
      "Es ist schmutzig, beschädigt oder teilweise verdeckt.",
      "Halten Sie an, wischen Sie das Etikett ab und fahren Sie weiter.",
    ],
    too_dark: ["Es ist zu dunkel", "Die Kamera sieht so gut wie nichts.", "Machen Sie Licht."],
    too_bright: [
      "Es ist zu hell",
      "Die Kamera wird geblendet.",
      "Schirmen Sie die Kamera ab oder blenden Sie die Scheinwerfer ab.",
    ],
    other_label: [
      "Dieses Etikett ist hier unbekannt",
      "Es gehört zu einem anderen Auto oder einem anderen Roboter.",
      "Fügen Sie das Auto zuerst hinzu oder drucken Sie sein Etikett mit diesem Roboter.",
    ],
    twice: ["Zwei Etiketten im Bild", "Beide geben sich als dasselbe Auto aus.", "Nehmen Sie die Kopie weg."],
    mirrored: [
      "Das Etikett ist spiegelverkehrt",
      "Die Kamera scheint in einen Spiegel zu sehen.",
      "Nehmen Sie den Spiegel weg.",
    ],
    no_vehicle: [
      "Noch kein Auto bekannt",
      "Der Roboter kann nicht sagen, wessen Etikett er sieht.",
      "Fügen Sie zuerst ein Auto hinzu und drucken Sie sein Etikett.",
    ],
    hidden: [
      "Stopp: Das Etikett ist verdeckt",
      "Eben war es noch im Bild. Etwas verdeckt es.",
      "Nehmen Sie weg, was davor ist, oder wischen Sie es ab.",
    ],
    left_at_left: [
      "Stopp: Das Etikett ist aus dem Bild",
      "Für den Roboter ist die Ladedose zu weit links.",
      "Fahren Sie ein wenig zurück, bis es wieder zu sehen ist.",
    ],
    left_at_right: [
      "Stopp: Das Etikett ist aus dem Bild",
      "Für den Roboter ist die Ladedose zu weit rechts.",
      "Fahren Sie ein wenig zurück, bis es wieder zu sehen ist.",
    ],
    left_at_top: [
      "Stopp: Das Etikett ist aus dem Bild",
      "Für den Roboter ist die Ladedose zu hoch.",
      "Fahren Sie ein wenig zurück, bis es wieder zu sehen ist.",
    ],
    left_at_bottom: [
      "Stopp: Das Etikett ist aus dem Bild",
      "Für den Roboter ist die Ladedose zu tief.",
      "Fahren Sie ein wenig zurück, bis es wieder zu sehen ist.",
    ],
    rolls: ["", "Geradeaus."],
    too_fast: ["", "Langsamer."],
    askew: ["", "Sie kommen schräg herein: Lenken Sie gerade."],
    stands: [
      "",
      "Der Roboter erreicht die Ladedose noch nicht.",
      "Fahren Sie zurück und noch einmal weiter seitlich herein.",
    ],
    too_low: [
      "Die Ladedose ist {distance} zu tief",
      "So weit kommt der Roboter nicht hinunter.",
      "Parken hilft hier nicht: Lassen Sie den Roboter tiefer montieren, oder wählen Sie einen anderen.",
    ],
    too_high: [
      "Die Ladedose ist {distance} zu hoch",
      "So weit kommt der Roboter nicht hinauf.",
      "Parken hilft hier nicht: Lassen Sie den Roboter höher montieren, oder wählen Sie einen anderen.",
    ],
    stop: ["Stopp", "Jetzt bremsen."],
    good: ["Hier anhalten", "Das Auto steht gut. Sie können aussteigen."],
    good_flawed: [
      "Hier anhalten",
      "Das Auto steht gut, aber sein Etikett sieht nicht so aus, wie es sollte.",
      "Wischen Sie das Etikett vor dem Laden ab.",
    ],
    thin: ["Gerade noch erreichbar", "Sie können stehen bleiben, aber es ist knapp."],
    skewed: [
      "Das Auto steht schräg",
      "Die Ladedose ist um {skew}° weggedreht; der Stecker kann höchstens {limit}° folgen.",
      "Prüfen Sie, ob Etikett und Ladedose noch so sitzen wie beim Einlernen.",
    ],
    skewed_left: [
      "Das Auto steht schräg",
      "Die Ladedose ist um {skew}° weggedreht; der Stecker kann höchstens {limit}° folgen.",
      "Fahren Sie zurück und gerader herein: Die Front zeigt zu weit nach links.",
    ],
    skewed_right: [
      "Das Auto steht schräg",
      "Die Ladedose ist um {skew}° weggedreht; der Stecker kann höchstens {limit}° folgen.",
      "Fahren Sie zurück und gerader herein: Die Front zeigt zu weit nach rechts.",
    ],
  },
  first: {
    forward: "{distance} vor",
    back: "{distance} zurück",
    left: "{distance} nach links",
    right: "{distance} nach rechts",
    up: "{distance} zu tief",
    down: "{distance} zu hoch",
  },
  further: {
    forward: "{distance} vor",
    back: "{distance} zurück",
    left: "{distance} weiter links",
    right: "{distance} weiter rechts",
  },
  and: " und ",
  also: "Und {steps}.",
  better: "Besser: {steps}.",
};

export const guidance: GuidanceWords = {
  title: "Einparkhilfe",
  show: "Zeigen",
  hide: "Ausblenden",
  directions: {
    forward: "vor",
    back: "zurück",
    left: "nach links",
    right: "nach rechts",
    up: "zu tief",
    down: "zu hoch",
  },
  sentences,
  picture: "Von oben gesehen: der Roboter, die Plätze, die er erreicht, und die Ladedose des Autos.",
  legendReach: "erreichbar",
  robot: "Roboter",
  skew: (degrees, limit) => `schräg ${degrees}° von ${limit}°`,
  sigma: (mm) => `Ladedose auf ± ${mm} mm bekannt`,
  simulated: {
    title: "Sie fahren das simulierte Auto",
    driveIn: "Einfahren",
    brake: "Bremsen",
    forward: "5 cm vor",
    back: "5 cm zurück",
    leave: "Wegfahren",
  },
};
