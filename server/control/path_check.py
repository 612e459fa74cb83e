"""Looking at a whole motion before its first step."""

from __future__ import annotations

from dataclasses import dataclass

from server.control.errors import ActuatorOverloadError, MotionOutOfReachError
from server.control.plug_guard import HELD, LATERAL_TOLERANCE_MM, PlugGuard
from twin.errors import TwinError
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import gamma
from twin.motion import MotionPlan, check_plan
from twin.statics import (
    ActuatorLimits,
    LoadCase,
    Loads,
    WorstForce,
    actuator_loads,
    forces_along,
)

PATH_SAMPLES = 24
FORCE_PERIOD_S = 0.02
"""Between two looks at the forces: the legs turn by a third of a degree at most."""

_NAMES = {"rho1": "left carriage", "rho2": "right carriage", "rho3": "slide"}


@dataclass(frozen=True, slots=True)
class Strength:
    """What the robot carries and what its actuators can.

    Attributes:
        loads: Masses, and the largest forces at the plug.
        actuators: Limits.
    """

    loads: Loads
    actuators: ActuatorLimits


DEFAULT_STRENGTH = Strength(Loads(), ActuatorLimits())


def check_path(
    geometry: RobotGeometry, plug: PlugGuard, plan: MotionPlan, strength: Strength
) -> None:
    """Do nothing if a motion is allowed along its whole length.

    Raises:
        LateralMotionForbiddenError: the plug forbids it.
        MotionOutOfReachError: it leaves the joint limits or the workspace.
        ActuatorOverloadError: it asks an actuator for more than it can hold.
    """
    step_s = plan.duration_s / PATH_SAMPLES
    waypoints = [plan.position_at(step_s * i) for i in range(1, PATH_SAMPLES + 1)]
    plug.check(plan.start.position, waypoints)
    try:
        check_plan(geometry, plan)
        # A plug that is in a socket must come out, however hard that is.
        if plug.state not in HELD or _goes_in(plan):
            _check_forces(geometry, plan, strength)
    except TwinError as error:
        raise MotionOutOfReachError(str(error)) from error


def can_hold(
    geometry: RobotGeometry, start: JointPosition, there: JointPosition, strength: Strength
) -> bool:
    """Whether the robot can stand somewhere, its plug free; at a push no worse than where it is.

    Raises:
        LegsCannotCloseError: one of the two poses does not exist or holds no force.
    """
    now = actuator_loads(geometry, start, strength.loads, LoadCase.HOLDING)
    then = actuator_loads(geometry, there, strength.loads, LoadCase.HOLDING)
    limits_n = strength.actuators.joints
    return all(
        abs(then_n) <= max(limit_n, abs(now_n))
        for then_n, limit_n, now_n in zip(then, limits_n, now, strict=True)
    )


def _goes_in(plan: MotionPlan) -> bool:
    """Only the plug moves, and outwards: it may meet a socket, and has to come back then."""
    by = [b - a for a, b in zip(plan.start.position, plan.end.position, strict=True)]
    return by[2] > 0 and max(abs(by[0]), abs(by[1])) <= LATERAL_TOLERANCE_MM


def _check_forces(geometry: RobotGeometry, plan: MotionPlan, strength: Strength) -> None:
    """Refuse what no actuator can hold, but not the way out of where the robot stands already."""
    loads, limits = strength.loads, strength.actuators
    holding = actuator_loads(geometry, plan.start.position, loads, LoadCase.HOLDING)
    pushing = (LoadCase.INSERTING, LoadCase.WITHDRAWING) if _goes_in(plan) else ()
    for case in (LoadCase.HOLDING, *pushing):
        found = forces_along(
            geometry, plan, case, loads=loads, limits=limits, period_s=FORCE_PERIOD_S
        )
        over = [
            worst
            for worst, now_n in zip((found.rho1, found.rho2, found.rho3), holding, strict=True)
            if abs(worst.force_n) > max(worst.limit_n, abs(now_n))
        ]
        if over:
            raise _overload(geometry, max(over, key=lambda worst: worst.utilisation), case)


def _overload(geometry: RobotGeometry, worst: WorstForce, case: LoadCase) -> ActuatorOverloadError:
    v = gamma.platform(geometry, worst.joints)
    doing = "" if case is LoadCase.HOLDING else f" while {case.value}"
    return ActuatorOverloadError(
        f"The {_NAMES[worst.joint]} would have to hold {abs(worst.force_n):.0f} N{doing} "
        f"{worst.time_s:.1f} s after the start, {-worst.margin_n:.0f} N more than its "
        f"{worst.limit_n:.0f} N; the platform is at x = {v.x_mm:.0f} mm, y = {v.y_mm:.0f} mm then.",
        joint=worst.joint,
        force_n=round(worst.force_n, 1),
        limit_n=worst.limit_n,
        excess_n=round(-worst.margin_n, 1),
        case=case.value,
        time_s=round(worst.time_s, 3),
        x_mm=round(v.x_mm, 1),
        y_mm=round(v.y_mm, 1),
        rho3_mm=round(worst.joints.rho3_mm, 1),
    )
