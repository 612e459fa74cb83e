"""The robot: state, stops, homing and jog steps."""

from __future__ import annotations

import asyncio

from fastapi import APIRouter

from server.api.dependencies import ServicesDep
from server.api.problems import problem_responses
from server.control.model import PlugState
from server.live.views import robot_view
from server.schema.link import LinkReport
from server.schema.robot import JogStep, PlugConfirmation, Reach, Robot, WayLeft
from server.services import Services

router = APIRouter(prefix="/robot", tags=["robot"])

_REFUSALS = problem_responses(409, 503)


def _now(services: Services) -> Robot:
    return robot_view(services.supervisor, services.runner.socket, services.calendar)


@router.get("", operation_id="getRobot", summary="Read the robot")
async def get_robot(services: ServicesDep) -> Robot:
    """The robot now."""
    return _now(services)


@router.get(
    "/reach", operation_id="getRobotReach", summary="Read the ways left", responses=_REFUSALS
)
async def get_reach(services: ServicesDep) -> Reach:
    """How far each axis can still go from here."""
    # Some milliseconds of kinematics, which the control loop shall not wait for.
    ways = await asyncio.to_thread(services.jog.ways_left_mm)
    return Reach(**{axis: WayLeft(back_mm=back, on_mm=on) for axis, (back, on) in ways.items()})


@router.get("/link", operation_id="getRobotLink", summary="Read how the link does")
async def get_link(services: ServicesDep) -> LinkReport:
    """How well the link to the motion board does; null is what nobody has measured."""
    return services.technician.link.report()


@router.post("/stop", operation_id="stopRobot", summary="Stop")
async def stop(services: ServicesDep) -> Robot:
    """Protective stop (category 2 of IEC 60204-1), in force until reset. Never refused."""
    await services.supervisor.stop()
    return _now(services)


@router.post("/estop", operation_id="emergencyStopRobot", summary="Emergency stop")
async def emergency_stop(services: ServicesDep) -> Robot:
    """Emergency stop (category 1), latched until reset. Never refused."""
    await services.supervisor.emergency_stop()
    return _now(services)


@router.post(
    "/reset", operation_id="resetRobot", summary="Release stops and faults", responses=_REFUSALS
)
async def reset(services: ServicesDep) -> Robot:
    """Release stop, emergency stop and fault. Nothing moves by itself afterwards."""
    await services.supervisor.reset()
    return _now(services)


@router.post(
    "/enable", operation_id="enableRobot", summary="Switch the drives on", responses=_REFUSALS
)
async def enable(services: ServicesDep) -> Robot:
    """Switch the drives on."""
    async with services.supervisor.control("jog", services.jog.operator) as lease:
        await services.supervisor.enable(lease)
    return _now(services)


@router.post(
    "/disable", operation_id="disableRobot", summary="Switch the drives off", responses=_REFUSALS
)
async def disable(services: ServicesDep) -> Robot:
    """Switch the drives off."""
    async with services.supervisor.control("jog", services.jog.operator) as lease:
        await services.supervisor.disable(lease)
    return _now(services)


@router.post(
    "/home", operation_id="homeRobot", summary="Find the zero of each axis", responses=_REFUSALS
)
async def home(services: ServicesDep) -> Robot:
    """Find the zero of each axis; answers when it is done."""
    async with services.supervisor.control("homing", "Homing") as lease:
        await services.supervisor.home(lease)
    return _now(services)


@router.post(
    "/jog",
    operation_id="jogRobot",
    summary="Move one step",
    responses=problem_responses(409, 422, 503),
)
async def jog(step: JogStep, services: ServicesDep) -> Robot:
    """One step of one axis; answers when it is done. Held motion goes over the WebSocket."""
    await services.jog.step(step.axis, step.distance_mm, step.speed_mm_s)
    return _now(services)


@router.post(
    "/plug-confirmation",
    operation_id="confirmPlug",
    summary="Say where the plug is",
    responses=problem_responses(409, 422),
)
async def confirm_plug(confirmation: PlugConfirmation, services: ServicesDep) -> Robot:
    """A person has looked and says where the plug is; refused when the station sees otherwise.

    A plug that is said to be in a car is at an unknown place afterwards, even if that is refused:
    then the robot only pulls it straight out.
    """
    async with services.supervisor.control("jog", "Somebody at the robot") as lease:
        await services.supervisor.take_plug_answer(lease, PlugState(confirmation.state))
    return _now(services)
