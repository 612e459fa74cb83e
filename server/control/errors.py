"""Errors of control.

ControlError
├── ControlBusyError             something else moves the robot
├── ControlLostError             the lease was ended while it was in use
├── ControlHeldError             another person is in control
├── NotInControlError            control is not this person's to give
├── NobodyAsksError              nobody waits for this answer
├── RequestPendingError          another person asks for control already
├── PeopleOnlyError              a program asks for control
├── RobotOfflineError            no link to the motion board
├── RobotNotReadyError           drives off or not homed
├── RobotStoppedError            a protective stop is in force
│   ├── TelemetryStaleError      nobody knew where the robot was
│   └── ReleaseRefusedError      the stop cannot be released yet
├── EmergencyStoppedError        an emergency stop is latched
├── RobotFaultError              the motion board latched a fault, or should have
│   ├── FaultRemainsError        it cannot be released: its cause is still there
│   ├── SlideStalledError        the slide does not move although it is told to
│   └── FollowingError           the slide is not where it should be
├── MotionRefusedError           the board refused the motion
├── LateralMotionForbiddenError  the plug is, or may be, in the socket
├── PlugSeenInCarError           a person says it is free, the station sees it in a car
├── PlugNotSeenError             a person says it is in a car, the station sees none
├── CalibrationHeldError         the same, and the calibration was to be changed
├── CalibrationUnusableError     no robot like the drawn one is built like that
├── MotionOutOfReachError        joint limit, workspace or singularity
├── ActuatorOverloadError        an actuator cannot hold what the motion asks of it
├── TargetGoneError              nobody wants to go there any more, or not from here
├── ForceLimitError              the force along the insertion axis went over its limit
│   └── ForceAboveBandError      it is more than the plug may meet at this depth
├── ForceBelowBandError          it is less: the plug is not in the socket
├── StillUnderLoadError          current flows, or may at any moment: the plug stays where it is
└── StationUnsafeError           nobody can tell whether current flows
"""

from __future__ import annotations

from server.errors import PlugPilotError


class ControlError(PlugPilotError):
    """The robot cannot do what was asked for."""

    code = "control"
    title = "The robot cannot do that now"
    status = 409


class ControlBusyError(ControlError):
    """Somebody else has control of the robot."""

    code = "control_busy"
    title = "Somebody else is using the robot"
    remedy = "Wait until they are done, or stop the robot first."


class ControlLostError(ControlError):
    """The lease was ended while it was in use."""

    code = "control_lost"
    title = "Control of the robot was taken away"
    remedy = "Start again when the robot is free."


class ControlHeldError(ControlError):
    """Another person is in control of the robot."""

    code = "control_held"
    title = "Somebody else is in control of the robot"
    remedy = "Ask for control on the page, or wait until it is free. You can stop the robot anyhow."


class NotInControlError(ControlError):
    """Control is not this person's to give."""

    code = "not_in_control"
    title = "You are not in control of the robot"
    remedy = "Look at the page to see who is."


class NobodyAsksError(ControlError):
    """Nobody waits for this answer."""

    code = "nobody_asks"
    title = "Nobody asks for control any more"
    remedy = "There is nothing to do."


class RequestPendingError(ControlError):
    """Another person asks for control already."""

    code = "control_request_pending"
    title = "Somebody else asks for control already"
    remedy = "Wait until that is answered, half a minute at most."


class PeopleOnlyError(ControlError):
    """A program asks for control, which only people can give and take."""

    code = "people_only"
    title = "Only people take control of the robot"
    status = 403
    remedy = "Use a paired browser. A program commands the robot while nobody is in control."


class RobotOfflineError(ControlError):
    """There is no link to the motion board."""

    code = "robot_offline"
    title = "The robot is not connected"
    status = 503
    remedy = "Check that the motion board has power and that its USB cable is plugged in."


class RobotNotReadyError(ControlError):
    """The drives are off, or the robot does not know its position."""

    code = "robot_not_ready"
    title = "The robot is not ready to move"
    remedy = "Switch the drives on and home the robot."


class RobotStoppedError(ControlError):
    """A protective stop is in force."""

    code = "stopped"
    title = "The robot was stopped"
    remedy = "Check that the way is clear, then release the stop."


class TelemetryStaleError(RobotStoppedError):
    """A moving robot was stopped because the news of it were too old."""

    code = "telemetry_stale"
    title = "The robot was stopped because nobody knew where it was"
    status = 503
    remedy = (
        "Check the USB cable of the motion board. The stop ends by itself when the plug is free "
        "and the news come in time again; otherwise release it here."
    )


class ReleaseRefusedError(RobotStoppedError):
    """A stop cannot be released, because something still speaks against it."""

    code = "release_refused"
    title = "The stop cannot be released yet"
    remedy = "Wait a moment, look at the robot, then release the stop again."


class EmergencyStoppedError(ControlError):
    """An emergency stop is latched."""

    code = "emergency_stopped"
    title = "The emergency stop is active"
    remedy = "Make sure that everyone is safe, then release the emergency stop and home the robot."


class RobotFaultError(ControlError):
    """The motion board latched a fault."""

    code = "robot_fault"
    title = "The robot stopped because of a fault"
    remedy = "Look at the robot for what caused it, then release the fault and try again."


class FaultRemainsError(RobotFaultError):
    """A fault cannot be released, because its cause is still there."""

    code = "fault_remains"
    title = "That cannot be released yet"
    remedy = (
        "Remove the cause first: unlock the emergency-stop button, take away what blocks the "
        "robot, or have the switch mended. Then release it again."
    )


class SlideStalledError(RobotFaultError):
    """The slide does not move although it is told to."""

    code = "slide_stalled"
    title = "The plug's slide does not move"
    remedy = (
        "Look for something that blocks the plug. If nothing does, have the slide's motor and its "
        "encoder checked."
    )


class FollowingError(RobotFaultError):
    """The slide is not where it should be."""

    code = "following_error"
    title = "The plug's slide does not follow"
    remedy = (
        "Look for something that brakes or pushes the plug. If nothing does, have the slide's "
        "motor and its encoder checked."
    )


class MotionRefusedError(ControlError):
    """The motion board refused a command."""

    code = "motion_refused"
    title = "The motion board refused to move"
    remedy = "Home the robot and try again."


class LateralMotionForbiddenError(ControlError):
    """The plug is, or may be, in the socket: only withdrawal is allowed."""

    code = "lateral_motion_forbidden"
    title = "The plug may be in the socket"
    remedy = "Unplug first. If the plug hangs free, confirm that on the page."


class PlugSeenInCarError(ControlError):
    """A person says that the plug is free, and the control pilot shows it in a car."""

    code = "plug_seen_in_car"
    title = "The charging station sees the plug in a car"
    remedy = (
        "Look again. If the plug is in, press Unplug. If it hangs free, the charging cable or the "
        "station is faulty: switch the station off, then confirm again."
    )


class PlugNotSeenError(ControlError):
    """A person says that the plug is in a car, and the control pilot shows none."""

    code = "plug_not_seen"
    title = "The charging station sees no car"
    remedy = (
        "Look again. If the plug is in, it is not all the way in: press Unplug, the robot pulls it "
        "straight out. If it hangs free, confirm that on the page."
    )


class CalibrationHeldError(ControlError):
    """The calibration cannot change while the plug is, or may be, in a socket."""

    code = "calibration_held"
    title = "The calibration cannot be changed now"
    remedy = "Unplug first. If the plug hangs free, confirm that on the page."


class CalibrationUnusableError(ControlError):
    """The numbers of a calibration belong to no robot like the drawn one."""

    code = "calibration_unusable"
    title = "The robot cannot move with this calibration"
    remedy = "Calibrate the robot again, or correct the numbers."


class MotionOutOfReachError(ControlError):
    """The motion would leave the joint limits or the workspace."""

    code = "out_of_reach"
    title = "The robot cannot reach that"
    remedy = "Choose a target nearer to the middle of the workspace."


class ActuatorOverloadError(ControlError):
    """The motion would ask an actuator for more force than it can hold."""

    code = "actuator_overload"
    title = "The robot is not strong enough for that"
    remedy = (
        "Choose a target further away from the rail, where the legs stand steeper, or let the "
        "cable hang from a hook. If the numbers are wrong, correct [loads] and [actuators]."
    )


class TargetGoneError(ControlError):
    """The place that was chosen is not the target any more."""

    code = "target_gone"
    title = "That way is not valid any more"
    remedy = "Choose the place again, and look at the new way."


class ForceLimitError(ControlError):
    """The force along the insertion axis went over its limit; the motion was stopped."""

    code = "force_limit"
    title = "The plug met too much resistance"
    remedy = "Check that nothing is in the socket or in the way of the plug."


class ForceAboveBandError(ForceLimitError):
    """The force is more than a plug may meet at this depth of its socket."""

    code = "force_above_band"
    title = "The plug meets more resistance than it should at this depth"


class ForceBelowBandError(ControlError):
    """The force is less than any socket gives at this depth."""

    code = "force_below_band"
    title = "The plug meets no socket"
    remedy = "Look where the plug went, and whether the car has moved."


class StillUnderLoadError(ControlError):
    """Current flows, or may at any moment: the plug must not move in its socket."""

    code = "under_load"
    title = "The charging current does not stop"
    remedy = "Switch the charging station off, then press Unplug again."


class StationUnsafeError(ControlError):
    """The station does not answer as it should: nobody can tell whether current flows."""

    code = "station_unsafe"
    title = "The charging station does not answer as it should"
    status = 502
    remedy = "Check that the charging station has power and is connected to the network."
