"""Measure the socket standing still, and move the plug in front of it."""

from __future__ import annotations

import asyncio

from server.jobs.approach import AT_THE_CENTRE, LateralOffset, lateral_error_mm, pre_insertion
from server.jobs.context import JobContext
from server.jobs.plugging.tilt import refuse_skewed
from server.localisation.errors import LabelNotFoundError, UncertainPoseError
from server.localisation.socket_pose import SocketPose

GOOD_ENOUGH_MM = 0.01
"""A smaller correction is below what the steps and belts deliver."""

MEASURE_AGAIN_MM = 1.0
"""After a larger correction the picture was taken from too far away to be the last word."""

MAX_MEASUREMENTS = 3


async def stand_before_socket(job: JobContext, offset: LateralOffset = AT_THE_CENTRE) -> None:
    """Measure at standstill and correct, until the plug stands where it should.

    The carriages come from below both to where the picture is taken and to where they go then, so
    that their play, however wide, is the same in both places and drops out.

    Args:
        job: The job.
        offset: Aim so far beside the measured centre.

    Raises:
        LabelNotFoundError: the label went out of sight.
        UncertainPoseError: the measurement is not certain enough.
        SocketUnreachableError: the measured socket is out of reach.
        SocketTooSkewedError: the socket is tilted too much.
        CameraDownError: the camera does not deliver.
    """
    supervisor = job.supervisor
    if not supervisor.play.from_below:
        here = supervisor.telemetry.require().commanded.position
        await supervisor.move_from_below(job.lease, here)
    for _ in range(MAX_MEASUREMENTS):
        correction_mm = await _measure_and_correct(job, offset)
        if correction_mm < MEASURE_AGAIN_MM:
            return
    raise UncertainPoseError(
        f"After {MAX_MEASUREMENTS} measurements the socket still seems to be "
        f"{correction_mm:.1f} mm from where the plug stands.",
        correction_mm=round(correction_mm, 2),
    )


async def _measure_and_correct(job: JobContext, offset: LateralOffset) -> float:
    """One measurement at standstill and the move it asks for; returns the move's length [mm]."""
    settings, supervisor, vehicle = job.settings.insertion, job.supervisor, job.require_vehicle()
    await asyncio.sleep(settings.settle_s)
    socket = await job.eye.measure(vehicle, settings.measurement_frames, job.socket)
    if socket is None:
        raise LabelNotFoundError(
            f"The label of {vehicle.name} cannot be read from in front of the socket.",
            payload=vehicle.label_payload,
        )
    _refuse_uncertain(socket, settings.max_lateral_sigma_mm)
    refuse_skewed(job, socket)
    job.see(socket)
    at = supervisor.telemetry.require().commanded.position
    target = pre_insertion(supervisor.geometry, socket, settings, offset)
    correction_mm = max(
        lateral_error_mm(supervisor.geometry, at, socket, offset),
        abs(target.rho3_mm - at.rho3_mm),
    )
    await job.journal.measured(
        "measured",
        "Measured the socket standing still.",
        lateral_sigma_mm=round(socket.lateral_sigma_mm, 4),
    )
    if correction_mm > GOOD_ENOUGH_MM:
        await supervisor.move_from_below(job.lease, target)
    return correction_mm


def _refuse_uncertain(socket: SocketPose, limit_mm: float) -> None:
    if socket.lateral_sigma_mm > limit_mm:
        raise UncertainPoseError(
            f"The socket's place is known to {socket.lateral_sigma_mm:.2f} mm only; "
            f"{limit_mm:.2f} mm are needed.",
            lateral_sigma_mm=round(socket.lateral_sigma_mm, 4),
            limit_mm=limit_mm,
        )
