/** What each routine is called, wants prepared, and wants to be told. */

export const routines = {
  camera: {
    name: "Calibrate the camera",
    purpose: "Focal length, centre and distortion, from pictures of the printed board in your hands.",
    prepare: [
      "Print the board at 100 %, and glue it onto something flat and stiff.",
      "Measure the side of its squares, best over five of them, and enter it here.",
      "Let the robot stand where you reach the camera, and stand so that you see this page. It does not move.",
    ],
    start: "Begin to look",
    done: "The camera has been calibrated",
  },
  switches: {
    name: "Limit switches",
    purpose: "How well they repeat: homes again and again, and looks where the robot then stands.",
    prepare: [
      "Let a car with its label stand before the robot, with the brake on.",
      "Let the plug hang freely at the robot.",
      "From now on nobody touches the car, the label or the robot.",
    ],
    start: "Begin to home",
    done: "The limit switches have been measured",
  },
  play: {
    name: "Play of the carriages",
    purpose: "Brings each carriage to one place from both sides: what differs is the play of its belt.",
    prepare: [
      "Let a car with its label stand before the robot, with the brake on.",
      "Let the plug hang freely at the robot.",
      "From now on nobody touches the car, the label or the robot.",
    ],
    start: "Begin to measure",
    done: "The play has been measured",
  },
  belts: {
    name: "Travel of the belts",
    purpose: "Moves both carriages along the rail, and asks how far they really went.",
    prepare: [
      "Have a rule of half a metre and a pencil at hand.",
      "Let the plug hang freely at the robot. No car is needed.",
      "The robot stops twice and asks: mark where the carriages stand, then measure how far they have gone.",
    ],
    start: "Go to the first place",
    done: "The belts have been measured",
  },
  robot: {
    name: "Measure the robot",
    purpose: "Legs, rails, belts and how the camera is turned, from 25 looks at one label.",
    prepare: [
      "Let the car stand so that its label is before the middle of the robot. A label on a board that stands firm does as well.",
      "Measure the travel of both belts first, and enter here what the rule said. The scale of everything comes from there.",
      "From now on nobody touches the car, the label or the robot.",
    ],
    start: "Begin to measure",
    done: "The robot has been measured",
  },
  force: {
    name: "Force of the slide",
    purpose: "Friction of the slide from strokes in the air and, against a spring, whether the force shown is true.",
    prepare: [
      "Let the plug hang freely at the robot. No car may stand close before it.",
      "Keep hands away from the plug.",
      "If you have a spring of known rate, the robot asks for it when it is wanted.",
    ],
    start: "Begin the strokes",
    done: "The slide has been measured",
  },
  socket: {
    name: "Teach a socket",
    purpose: "Where the socket is beside its label, with the plug all the way in.",
    prepare: [
      "Measure the robot first: another calibration of the robot moves what was taught.",
      "Bring the plug all the way in. Jog slowly and feel the play on both sides, or let a job plug in.",
      "The robot looks, draws the plug out along its axis and looks again. The car must not rock.",
    ],
    start: "The plug is in: teach",
    done: "The socket has been taught",
  },
  check: {
    name: "Check at nine places",
    purpose: "How exactly the robot goes where it is sent, in the terms of ISO 9283.",
    prepare: [
      "Let the car stand so that its label is before the middle of the robot: it must be in the picture from at least four places.",
      "The robot goes to nine places, to each from below and from above.",
      "From now on nobody touches the car, the label or the robot.",
    ],
    start: "Begin the check",
    done: "The check is done",
  },
};

export const fields = {
  leftSent: "Left carriage: sent, mm",
  leftWent: "really went, mm",
  rightSent: "Right carriage: sent, mm",
  rightWent: "really went, mm",
  label: "The label’s side was measured to, ± mm",
  approaches: "Approaches of each place, from each side",
  homings: "How often it homes",
  reversals: "Approaches with each carriage, from each side",
  distance: "Distance, mm",
  reading: "The rule is read to, ± mm",
  strokes: "Strokes, there and back",
  stroke: "Length of a stroke, mm",
  spring: "Rate of the spring, N/mm",
  springKnown: "The rate is known to, ± %",
  square: "Side of a square, mm",
};

export const fieldHints = {
  belts: "Leave empty what the routine for the belts has measured and is in use. Without either, the scale is known to a quarter percent only.",
  spring: "Leave the rate empty if there is no spring: friction is measured all the same.",
};
