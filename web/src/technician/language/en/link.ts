/** Every sentence of the panel for the link to the board. */
import type { LinkVerdict } from "../../link/verdict";

/** The word, and what to do. */
const verdicts: Record<LinkVerdict, readonly [string, string]> = {
  asking: ["Waiting", "The link is being asked."],
  offline: ["No link", "No telemetry comes. Check the USB cable and the board’s supply; the box of the robot says what is missing."],
  interrupted: ["Interrupted", "The link was lost and opened anew in the last minutes. Check that both plugs of the USB cable sit firmly."],
  damaged: ["Damaged frames", "Check the USB cable and its shield, and lay it away from the motor cables."],
  slow: ["Slow", "Answers or samples come late or not at all. Is the computer busy, or does the cable go through a hub?"],
  good: ["Good", "Answers come at once, and no damage is seen."],
};

export const link = {
  title: "Link to the board",
  hint: "Delays, rate, damage",
  now: "Now",
  sinceOpened: "Since the link was opened",
  rate: "Telemetry rate",
  age: "Age of the newest sample",
  delay: "Delay of a sample",
  roundTrip: "Round trip",
  median: "Round trip, median",
  worst: "Round trip, slowest",
  supply: "Supply of the board",
  temperature: "Temperature of the board",
  received: "Frames received",
  damaged: "Frames damaged here",
  damagedAtBoard: "Frames damaged at the board",
  again: "Messages sent again",
  reconnections: "Reconnected since the start",
  unmeasured: "–: nobody measures it, such as damage on a simulated link.",
  times: "Round trip and delay, ms",
  late: "Delay",
  rateOverTime: "Telemetry rate, Hz",
  unknown: "–",
  verdicts,
};
