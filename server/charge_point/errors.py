"""Errors of the charge point.

ChargePointError
├── RestingError      it waits until somebody resumes it
└── UnpluggingError   the robot is on its way out of the car
"""

from __future__ import annotations

from server.errors import PlugPilotError


class ChargePointError(PlugPilotError):
    """The charge point cannot do that now."""

    code = "charge_point"
    title = "The charge point cannot do that now"
    status = 409


class RestingError(ChargePointError):
    """It waits until somebody resumes it."""

    code = "charge_point_resting"
    title = "The charge point rests until somebody resumes it"
    remedy = "Resume it with POST /api/v1/charge-point/resume, or start a job by hand."


class UnpluggingError(ChargePointError):
    """The robot is on its way out of the car."""

    code = "charge_point_unplugging"
    title = "The robot is unplugging the car"
    remedy = "Try again when it is parked."
