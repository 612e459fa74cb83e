/** Short names for the wire types of calibration. */
import type { components } from "@/api/schema";

type Schemas = components["schemas"];

export type Calibration = Schemas["Calibration"];
export type CalibrationDetail = Schemas["CalibrationDetail"];
export type CalibrationKind = Schemas["CalibrationKind"];
export type CalibrationPage = Schemas["CalibrationPage"];
export type CalibrationsInForce = Schemas["CalibrationsInForce"];
export type Look = Schemas["LookRecord"];
export type BoardLook = Schemas["BoardLook"];
export type CameraEvidence = Schemas["CameraEvidence"];
export type RobotEvidence = Schemas["RobotEvidence"];
export type Routine = Schemas["Routine"];
export type RoutineKind = Routine["kind"];
export type Question = Schemas["RoutineQuestion"];
export type Figure = Schemas["RoutineFigure"];
export type Drift = Schemas["BeltDrift"];
export type Hint = Schemas["MaintenanceHint"];
export type Mechanism = Schemas["PlanarAsBuilt"];
export type RobotValues = Schemas["RobotValues"];
export type AccuracyCheck = Schemas["AccuracyCheck"];
export type AccuracyCheckPage = Schemas["AccuracyCheckPage"];
export type CheckedPlace = Schemas["CheckedPlace"];

/** A place in the base frame, x along the rail and y up [mm]. */
export interface Place {
  readonly x_mm: number;
  readonly y_mm: number;
}
