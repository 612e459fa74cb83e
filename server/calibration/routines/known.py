"""What is known before the robot's routine looks: typed in now, in force, or usual."""

from __future__ import annotations

from server.calibration.axes.estimates import Estimate, belt_scale
from server.calibration.robot.known_before import KnownBefore
from server.calibration.routines.stand import Stand
from server.schema.routines import RobotRoutineRequest

LENS_SIGMAS_RAD = (2e-4, 3e-3)
"""Of the picture's centre over the focal length: as the board tells it, and as the data sheet does,
8 px in 95 of 100 cameras."""


def lens_is_measured(stand: Stand) -> bool:
    """Whether the camera's numbers are its own, or those of the data sheet."""
    camera = stand.settings.camera
    return stand.eye.optics != camera.optics or camera.calibration is not None


def lens_sigma_rad(stand: Stand) -> float:
    """How well the picture's centre is known, over the focal length."""
    return LENS_SIGMAS_RAD[0 if lens_is_measured(stand) else 1]


def known_before(
    request: RobotRoutineRequest,
    label_size_mm: float,
    in_force: tuple[Estimate, Estimate] | None,
    lens_sigma_rad: float = LENS_SIGMAS_RAD[0],
) -> KnownBefore:
    """What the technician has measured, now or for the calibration in force, or is usual.

    Args:
        request: With what was typed in.
        label_size_mm: As entered.
        in_force: Scale of both belts; None: no rule has told.
        lens_sigma_rad: How well the picture's centre is known.
    """
    belts = [
        belt_scale(typed.commanded_mm, typed.measured_mm, typed.reading_sigma_mm)
        if typed is not None
        else before
        for typed, before in zip(
            (request.left_belt, request.right_belt), in_force or (None, None), strict=True
        )
    ]
    known = {
        "label_ratio_sigma": request.label_sigma_mm / label_size_mm,
        "lens_sigma_rad": lens_sigma_rad,
    }
    for name, belt in zip(("left_scale", "right_scale"), belts, strict=True):
        if belt is not None:
            known[name] = belt.value
    measured = [belt.sigma for belt in belts if belt is not None]
    if len(measured) == len(belts):
        known["scale_sigma"] = max(measured)
    return KnownBefore.model_validate(known)
