"""From the board's telemetry to the state that the rest of the project knows."""

from __future__ import annotations

from collections.abc import Sequence

from drivers.arduino.protocol import messages
from drivers.arduino.protocol.messages import State, TelemetryFlag
from drivers.arduino.scale import AxisScale
from drivers.arduino.steps import WirePoint
from drivers.arduino.words import STATES, fault_of
from drivers.robot import (
    BoardState,
    CommandedJoints,
    LimitSwitches,
    MeasuredJoints,
    RobotState,
)
from twin.joints import JointPosition, JointVelocity

NOT_MEASURED_DC = -(1 << 15)


def supply_v(sample: messages.Telemetry) -> float | None:
    """Supply voltage of the board [V]; None before it was measured."""
    return sample.supply_mv / 1000 if sample.supply_mv else None


def temperature_degc(sample: messages.Telemetry) -> float | None:
    """Temperature on the board [degC]; None before it was measured."""
    return None if sample.temperature_dc == NOT_MEASURED_DC else sample.temperature_dc / 10


def robot_state(
    sample: messages.Telemetry,
    point: WirePoint | None,
    scales: Sequence[AxisScale],
    *,
    sampled_at_s: float,
    received_at_s: float,
    queue_capacity: int,
) -> RobotState:
    """The state of one sample.

    Args:
        sample: From the board.
        point: Where the segments lead at that instant, if known: exact, with parts of a step.
        scales: Of the three axes.
        sampled_at_s: On the host's clock.
        received_at_s: The same.
        queue_capacity: Segments the board can hold.

    Raises:
        ValueError: the board reports a state or fault that this version does not know.
    """
    board = STATES[State(sample.state)]
    flags = TelemetryFlag(sample.flags)
    counted = [s.mm_of_units(units) for s, units in zip(scales, sample.commanded, strict=True)]
    rates = [
        s.mm_s_of_telemetry(rate) for s, rate in zip(scales, sample.commanded_rate, strict=True)
    ]
    slide = scales[2]
    measured = MeasuredJoints(
        JointPosition(counted[0], counted[1], slide.mm_of_units(sample.measured_rho3)),
        JointVelocity(rates[0], rates[1], slide.mm_s_of_telemetry(sample.measured_rate_rho3)),
    )
    if point is None:
        commanded = CommandedJoints(JointPosition(*counted), JointVelocity(*rates))
    else:
        commanded = CommandedJoints(
            JointPosition(*(s.mm(p) for s, p in zip(scales, point.position, strict=True))),
            JointVelocity(*(s.mm_s(r) for s, r in zip(scales, point.rate, strict=True))),
        )
    homing = board is BoardState.HOMING
    return RobotState(
        sampled_at_s=sampled_at_s,
        received_at_s=received_at_s,
        board=board,
        measured=measured,
        commanded=commanded,
        force_n=sample.force_dn / 10,
        enabled=TelemetryFlag.ENABLED in flags,
        homed=TelemetryFlag.HOMED in flags,
        switches=LimitSwitches(
            TelemetryFlag.SWITCH_RHO1 in flags,
            TelemetryFlag.SWITCH_RHO2 in flags,
            TelemetryFlag.SWITCH_RHO3 in flags,
        ),
        queue_free=0 if homing else queue_capacity - sample.queue_used,
        segments_done=sample.segment,
        fault=fault_of(sample.fault, sample.fault_detail, flags),
    )
