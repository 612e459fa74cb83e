/** Which steps a person follows when the robot cannot go on alone. */
import type { ProblemCode } from "@/language/problems";

/** One thing to do or to look at. Each has a sentence in every language, and a drawing. */
export type Step =
  | "clear"
  | "lookAtPlug"
  | "plugIsOut"
  | "plugIsIn"
  | "findReason"
  | "twistButton"
  | "parkHere"
  | "parkStraight"
  | "openFlap"
  | "wipeLabel"
  | "switchLightOn"
  | "checkLabel"
  | "emptySocket"
  | "freeCable"
  | "unlockCar"
  | "endCharge"
  | "stationOff"
  | "stationOn"
  | "stationNetwork"
  | "robotPower"
  | "usbCable"
  | "comesBack"
  | "unblock"
  | "findsPosition"
  | "checkCamera"
  | "carStandsStill"
  | "technician";

type Guide = readonly Step[];

const PLUG: Guide = ["lookAtPlug", "plugIsOut", "plugIsIn", "clear"];
const EMERGENCY: Guide = ["findReason", "twistButton", "clear"];
const STOPPED: Guide = ["findReason", "clear"];
const LABEL: Guide = ["parkHere", "openFlap", "wipeLabel", "switchLightOn"];
const SHARPNESS: Guide = ["wipeLabel", "switchLightOn", "checkLabel"];
const LABEL_PLACE: Guide = ["checkLabel", "parkHere", "technician"];
const PARKING: Guide = ["parkStraight", "openFlap"];
const LOAD_OF_ARM: Guide = ["freeCable", "parkStraight", "clear"];
const JAM: Guide = ["openFlap", "emptySocket", "freeCable", "clear"];
const MISSED: Guide = ["carStandsStill", "checkLabel", "clear"];
const CAR_GONE: Guide = ["carStandsStill", "lookAtPlug", "clear"];
const LOCKED: Guide = ["unlockCar", "clear"];
const CURRENT: Guide = ["endCharge", "stationOff", "clear"];
const STATION: Guide = ["stationOn", "stationNetwork", "clear"];
const CONTACT: Guide = ["emptySocket", "stationOn", "clear"];
const LINK: Guide = ["robotPower", "usbCable", "comesBack"];
const LINK_LOST_ONCE: Guide = ["usbCable", "robotPower", "clear"];
const BLOCKED: Guide = ["unblock", "freeCable", "clear"];
const RESTART: Guide = ["clear", "findsPosition", "technician"];
const REPAIR: Guide = ["clear", "technician"];
const CAMERA: Guide = ["checkCamera", "technician", "clear"];
const OUTAGE: Guide = ["carStandsStill", "robotPower", "clear"];
/** For a code that is not known here, from a newer server. */
const UNKNOWN: Guide = ["lookAtPlug", "clear", "technician"];

type Asked = ProblemCode | "plug_unknown";

const GUIDES: Readonly<Partial<Record<Asked, Guide>>> = {
  plug_unknown: PLUG,
  plug_state: PLUG,
  plug_seen_in_car: PLUG,
  plug_not_seen: PLUG,
  lateral_motion_forbidden: PLUG,
  emergency_stop: EMERGENCY,
  emergency_stopped: EMERGENCY,
  stopped: STOPPED,
  label_not_found: LABEL,
  localisation: LABEL,
  pose_uncertain: SHARPNESS,
  place_implausible: LABEL_PLACE,
  label_size_wrong: LABEL_PLACE,
  socket_unreachable: PARKING,
  socket_too_skewed: PARKING,
  out_of_reach: PARKING,
  actuator_overload: LOAD_OF_ARM,
  insertion_jammed: JAM,
  insertion_depth: JAM,
  force_limit: JAM,
  force_above_band: JAM,
  stall: JAM,
  plug_missed: MISSED,
  force_below_band: MISSED,
  car_gone: CAR_GONE,
  connector_locked: LOCKED,
  under_load: CURRENT,
  station_unsafe: STATION,
  no_contact: CONTACT,
  robot_offline: LINK,
  board_not_found: LINK,
  board_silent: LINK,
  link_lost: LINK,
  heartbeat_lost: LINK_LOST_ONCE,
  telemetry_stale: LINK_LOST_ONCE,
  following_error: BLOCKED,
  slide_stalled: BLOCKED,
  limit_switch: BLOCKED,
  homing_failed: BLOCKED,
  motion_refused: BLOCKED,
  robot_not_ready: RESTART,
  watchdog: RESTART,
  segment_mismatch: RESTART,
  queue_underrun: RESTART,
  robot_fault: REPAIR,
  fault_remains: REPAIR,
  release_refused: REPAIR,
  wrong_firmware: REPAIR,
  board_refused: REPAIR,
  calibration_unusable: REPAIR,
  internal: REPAIR,
  camera_down: CAMERA,
  interrupted: OUTAGE,
  long_outage: OUTAGE,
  restarted_too_often: OUTAGE,
};

/** The steps for what a person is asked about. */
export function guideOf(code: string): Guide {
  return Object.hasOwn(GUIDES, code) ? GUIDES[code as Asked]! : UNKNOWN;
}

/** Codes that have steps of their own. */
export const GUIDED = Object.keys(GUIDES);
