/** Short names for the generated wire types. */
import type { components } from "./schema";

type Schemas = components["schemas"];

export type Live = Schemas["Live"];
export type Robot = Schemas["Robot"];
export type RobotMode = Schemas["RobotMode"];
export type PlugState = Schemas["PlugState"];
export type Station = Schemas["Station"];
export type Control = Schemas["Control"];
export type ControlPerson = Schemas["ControlPerson"];
export type Service = Schemas["Service"];
export type Job = Schemas["Job"];
export type JobType = Schemas["JobType"];
export type JobState = Schemas["JobState"];
export type JobPhase = Schemas["JobPhase"];
export type JobRequest = Schemas["JobRequest"];
export type Outlook = Schemas["Outlook"];
export type Milestone = Schemas["Milestone"];
export type NeedsPerson = Schemas["NeedsPerson"];
export type JobPage = Schemas["JobPage"];
export type Playback = Schemas["Playback"];
export type Guidance = Schemas["Guidance"];
export type GuidanceStep = Schemas["GuidanceStep"];
export type GuidanceReason = Guidance["reason"];
export type GuidedCar = Schemas["GuidedCar"];
export type CarCommand =
  | Schemas["DriveIn"]
  | Schemas["DriveOn"]
  | Schemas["Brake"]
  | Schemas["Leave"];
export type Divergence = Schemas["DivergenceReport"];
export type Quantity = Schemas["Quantity"];
export type Problem = Schemas["Problem"];
export type Vehicle = Schemas["Vehicle"];
export type VehicleList = Schemas["VehicleList"];

export type SnapshotMessage = Schemas["SnapshotMessage"];
export type DeltaMessage = Schemas["DeltaMessage"];
export type ReplyMessage = Schemas["ReplyMessage"];
export type ServerMessage = SnapshotMessage | DeltaMessage | ReplyMessage;

export type Reach = Schemas["Reach"];
export type Configuration = Schemas["Configuration"];
export type ConfigurationCheck = Schemas["ConfigurationCheck"];
export type ConfigurationField = Schemas["ConfigurationField"];
export type ConfigurationFields = Schemas["ConfigurationFields"];
export type ConfigurationHistory = Schemas["ConfigurationHistory"];
export type ConfigurationVersion = Schemas["ConfigurationVersion"];
export type Versions = Schemas["Versions"];
export type ProtocolFrame = Schemas["ProtocolFrame"];
export type ProtocolFrames = Schemas["ProtocolFrames"];
export type LinkReport = Schemas["LinkReport"];
export type MoveTarget = Schemas["MoveTarget"];
export type CameraInspection = Schemas["CameraInspection"];
export type JogMessage = Schemas["JogMessage"];
export type JogStepMessage = Schemas["JogStepMessage"];
export type JogAxis = JogMessage["axis"];
export type ClientMessage = Schemas["ClientMessage"];
/** A message whose answer is awaited: the channel numbers it. */
export type Question = DistributiveOmit<ClientMessage, "id">;
type DistributiveOmit<T, K extends keyof T> = T extends unknown ? Omit<T, K> : never;

export type StopKind = "stop" | "emergency_stop";

/** The one protocol version this page speaks. */
export const PROTOCOL_VERSION: SnapshotMessage["version"] = 1;
