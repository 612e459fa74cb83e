"""Bring the plug before the socket: correct on the way, then measure standing still."""

from __future__ import annotations

import asyncio
import math

from server.control.motion import Motion
from server.jobs.approach import pre_insertion, waiting_before
from server.jobs.context import JobContext
from server.jobs.model import JobPhase
from server.jobs.plugging.measuring import stand_before_socket

RETARGET_MM = 0.05
"""A smaller change of the target is left to the measurement at standstill."""


async def run(job: JobContext) -> None:
    """Go to the pre-insertion point and correct it by a measurement at standstill.

    Raises:
        LabelNotFoundError: the label went out of sight.
        UncertainPoseError: the measurement is not certain enough.
        SocketUnreachableError: the measured socket is out of reach.
    """
    await job.journal.begin(JobPhase.ALIGNING, "Moving the plug in front of the socket.")
    await _approach(job)
    await stand_before_socket(job)


async def _approach(job: JobContext) -> None:
    supervisor, settings = job.supervisor, job.settings.insertion
    goal = pre_insertion(supervisor.geometry, job.require_socket(), settings)
    motion = supervisor.start_from_below(job.lease, waiting_before(goal))
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
            goal = pre_insertion(job.supervisor.geometry, seen, job.settings.insertion)
            job.supervisor.retarget(motion, waiting_before(goal))
