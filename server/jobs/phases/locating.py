"""Find the label: look from here first, then from where it may be seen."""

from __future__ import annotations

import asyncio
import math
from collections.abc import Sequence

from server.control.errors import ActuatorOverloadError, MotionOutOfReachError
from server.jobs.approach import pre_insertion
from server.jobs.context import JobContext
from server.jobs.model import JobPhase
from server.jobs.plugging.tilt import refuse_skewed
from server.labels.recognise import why_not_the_label
from server.localisation.errors import LabelNotFoundError
from server.localisation.eye import Refusal
from server.localisation.looks import Look, LookPlanner
from server.localisation.socket_pose import SocketPose
from server.localisation.telling import most_telling
from server.schema.vehicles import Vehicle
from server.vision.errors import WrongPayloadError
from twin.joints import JointPosition, TipPosition
from twin.kinematics import gamma


async def run(job: JobContext) -> None:
    """Find the socket and make sure that the plug can get there.

    Raises:
        LabelNotFoundError: the label is in none of the looks.
        SocketUnreachableError: the socket is out of reach.
        SocketTooSkewedError: the socket is tilted too much.
        CameraDownError: the camera does not deliver.
    """
    await job.journal.begin(JobPhase.LOCATING, "Looking for the label beside the socket.")
    socket = await _search(job)
    job.see(socket)
    refuse_skewed(job, socket)
    pre_insertion(job.supervisor.geometry, socket, job.settings.insertion)
    entry = socket.entry
    await job.journal.note(
        "label_found",
        "Found the label.",
        x_mm=round(entry.x_mm, 2),
        y_mm=round(entry.y_mm, 2),
        z_mm=round(entry.z_mm, 2),
        lateral_sigma_mm=round(socket.lateral_sigma_mm, 4),
        tilt_deg=round(math.degrees(socket.tilt_rad(job.supervisor.geometry)), 2),
    )


async def _search(job: JobContext) -> SocketPose:
    insertion, vehicle = job.settings.insertion, job.require_vehicle()
    socket = await job.eye.look(vehicle)
    if socket is not None:
        return socket
    refusals = [job.eye.refusal]
    planner = LookPlanner(
        job.supervisor.geometry, job.supervisor.built, job.eye.known, vehicle, insertion
    )
    joints = job.supervisor.telemetry.require().commanded.position
    here = gamma.platform(job.supervisor.geometry, joints)
    left_out = 0
    places = planner.further_looks(here.x_mm, here.y_mm, joints.rho3_mm)
    # in a thread: what a picture shows of all places takes a small computer its time
    while (place := await asyncio.to_thread(next, places, None)) is not None:
        try:
            await job.supervisor.move_from_below(job.lease, _joints_at(job, place))
        except (MotionOutOfReachError, ActuatorOverloadError):
            left_out += 1
            continue
        socket = await job.eye.look(vehicle)
        refusals.append(job.eye.refusal)
        await job.journal.note(
            "look",
            "Looked from another place.",
            x_mm=round(place.x_mm, 1),
            y_mm=round(place.y_mm, 1),
            found=socket is not None,
        )
        if socket is not None:
            return socket
    instead = _what_was_there(refusals, vehicle)
    together = "" if left_out else " that together show every place where it may be"
    raise LabelNotFoundError(
        f"The label of {vehicle.name} was in none of {len(refusals)} pictures{together}."
        f"{' ' if instead else ''}{instead}",
        looks=len(refusals),
        payload=vehicle.label_payload,
    )


def _what_was_there(refusals: Sequence[Refusal | None], vehicle: Vehicle) -> str:
    """What the most telling picture showed instead; "" when all showed nothing."""
    refusal = most_telling(refusals)
    if isinstance(refusal, WrongPayloadError):
        return why_not_the_label(refusal.context["found"], vehicle.label_payload)
    return "" if refusal is None else refusal.detail


def _joints_at(job: JobContext, look: Look) -> JointPosition:
    geometry = job.supervisor.geometry
    rho3_mm = job.supervisor.telemetry.require().commanded.position.rho3_mm
    dy_mm, z_mm = gamma.tip_offset(geometry, rho3_mm)
    return gamma.inverse(geometry, TipPosition(look.x_mm, look.y_mm + dy_mm, z_mm))
