"""Bring the plug before the socket: correct on the way, then measure standing still."""

from __future__ import annotations

import asyncio
import math

from server.control.motion import Motion
from server.jobs.approach import lateral_error_mm, pre_insertion
from server.jobs.context import JobContext
from server.jobs.model import JobPhase
from server.jobs.phases.locating import refuse_skewed
from server.localisation.errors import LabelNotFoundError, UncertainPoseError
from server.localisation.socket_pose import SocketPose
from twin.motion import plan_joint_move

RETARGET_MM = 0.05
"""A smaller change of the target is left to the measurement at standstill."""

GOOD_ENOUGH_MM = 0.01
"""A smaller correction is below what the steps and belts deliver."""

MEASURE_AGAIN_MM = 1.0
"""After a larger correction the picture was taken from too far away to be the last word."""

MAX_MEASUREMENTS = 3


async def run(job: JobContext) -> None:
    """Go to the pre-insertion point and correct it by a measurement at standstill.

    Raises:
        LabelNotFoundError: the label went out of sight.
        UncertainPoseError: the measurement is not certain enough.
        SocketUnreachableError: the measured socket is out of reach.
    """
    await job.journal.begin(JobPhase.ALIGNING, "Moving the plug in front of the socket.")
    await _approach(job)
    for _ in range(MAX_MEASUREMENTS):
        correction_mm = await _measure_and_correct(job)
        if correction_mm < MEASURE_AGAIN_MM:
            return
    raise UncertainPoseError(
        f"After {MAX_MEASUREMENTS} measurements the socket still seems to be "
        f"{correction_mm:.1f} mm from where the plug stands.",
        correction_mm=round(correction_mm, 2),
    )


async def _approach(job: JobContext) -> None:
    supervisor, settings = job.supervisor, job.settings.insertion
    target = pre_insertion(supervisor.geometry, job.require_socket(), settings)
    start = supervisor.telemetry.require().commanded.position
    plan = plan_joint_move(supervisor.limits, start, target)
    motion = supervisor.start_motion(job.lease, plan, changeable=True)
    tasks = {
        asyncio.create_task(supervisor.run(motion), name="approach"),
        asyncio.create_task(_correct_on_the_way(job, motion), name="coarse correction"),
    }
    try:
        done, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_EXCEPTION)
        for task in done:
            task.result()
    finally:
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)


async def _correct_on_the_way(job: JobContext, motion: Motion) -> None:
    """Bend the motion whenever a picture taken on the way shows the socket elsewhere."""
    while not motion.last_leg:
        seen = await job.eye.look(job.require_vehicle(), job.socket)
        if seen is None or motion.last_leg:
            continue
        shift_mm = math.dist(seen.entry, job.require_socket().entry)
        job.see(seen)
        if shift_mm > RETARGET_MM:
            target = pre_insertion(job.supervisor.geometry, seen, job.settings.insertion)
            job.supervisor.retarget(motion, target)


async def _measure_and_correct(job: JobContext) -> float:
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
    target = pre_insertion(supervisor.geometry, socket, settings)
    correction_mm = max(
        lateral_error_mm(supervisor.geometry, at, socket), abs(target.rho3_mm - at.rho3_mm)
    )
    await job.journal.measured(
        "measured",
        "Measured the socket standing still.",
        lateral_sigma_mm=round(socket.lateral_sigma_mm, 4),
    )
    if correction_mm > GOOD_ENOUGH_MM:
        await supervisor.move_joints(job.lease, target)
    return correction_mm


def _refuse_uncertain(socket: SocketPose, limit_mm: float) -> None:
    if socket.lateral_sigma_mm > limit_mm:
        raise UncertainPoseError(
            f"The socket's place is known to {socket.lateral_sigma_mm:.2f} mm only; "
            f"{limit_mm:.2f} mm are needed.",
            lateral_sigma_mm=round(socket.lateral_sigma_mm, 4),
            limit_mm=limit_mm,
        )
