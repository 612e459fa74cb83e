"""How soon the real firmware reacts, in simulated time: what is promised, and what was measured.

``pytest -s`` shows the figures.
"""

from __future__ import annotations

import asyncio

import pytest

from drivers.arduino.driver import ArduinoRobot
from drivers.arduino.protocol.messages import (
    HEARTBEAT_TIMEOUT_MS,
    TICK_HZ,
)
from drivers.camera import pi_camera_v2
from drivers.robot import BoardState, StopCategory
from drivers.simulator.garage import build_garage
from drivers.simulator.parameters import SimulationParameters
from server.config.supervision import SupervisionSettings
from server.control.jog import Jog
from server.control.supervisor import Supervisor
from server.timing import Calendar
from tests.rig.host import LIMITS, move, on_the_way, plan, ready, sample_where
from tests.rig.rig import USB_LATENCY_S, Rig
from tests.rig.stepping import braking_begins_s, speed_steps_s, steps_after
from tests.rig.truth import Step
from tests.support.eventually import eventually
from tests.support.robot_cell import MemoryPlug
from twin.camera_mount import CameraMount
from twin.joints import JointPosition
from twin.motion import MotionLimits

pytestmark = pytest.mark.asyncio(loop_scope="module")

LEFT = JointPosition(60.0, 240.0, 60.0)
RIGHT = JointPosition(240.0, 60.0, 60.0)

TICK_S = 1 / TICK_HZ
HEARTBEAT_S = 0.25
"""Longest time from the last sign of life to the beginning of the stop."""

STOP_S = 0.005
"""Longest time from the arrival of a stop to the first deceleration."""

JOG_MM_S = 20.0
JOG_STOP_S = 0.15
"""Longest time from letting a button go to standstill, at the largest jog speed."""


def ramp_s(mm_s: float, rig: Rig) -> float:
    """How long the carriages' own deceleration takes from a speed."""
    return mm_s / rig.machine.settings.rho1.stop_deceleration_mm_s2


def simulated_s(rig: Rig, loop_s: float) -> float:
    """Simulated time of an instant of the event loop."""
    return loop_s - rig.loop_time_s(0.0)


def steady(mm_s: float) -> MotionLimits:
    """Limits that make both carriages cruise at a speed."""
    cruise = LIMITS.rho1.model_copy(update={"velocity_mm_s": mm_s})
    return LIMITS.model_copy(update={"rho1": cruise, "rho2": cruise})


async def test_a_lost_heartbeat_ends_the_motion_in_time(homed: tuple[Rig, ArduinoRobot]) -> None:
    rig, robot = homed

    async def has_stopped() -> bool:
        return not (await rig.control.state()).relay

    await ready(rig, robot, LEFT)
    await rig.control.record_steps()
    async with on_the_way(robot, RIGHT):
        await asyncio.sleep(0.2)
        assert rig.cable.end is not None
        heard_s = simulated_s(rig, rig.cable.end.last_write_s) + USB_LATENCY_S
        await rig.control.cut_link()
        await eventually(has_stopped)
        async for _ in robot.telemetry():
            pass  # until the driver, too, has noticed
    steps, _ = await rig.control.recorded_steps()
    await rig.control.cut_link(cut=False)
    await robot.connect()
    begins_s, ends_s = braking_begins_s(steps, heard_s), steps[-1].at_s
    print(
        f"\nlast sign of life to the beginning of the stop {(begins_s - heard_s) * 1e3:.1f} ms, "
        f"to standstill {(ends_s - heard_s) * 1e3:.1f} ms "
        f"(ramp {ramp_s(80.0, rig) * 1e3:.1f} ms)"
    )
    assert begins_s - heard_s > HEARTBEAT_TIMEOUT_MS / 1000 - 0.01, "no earlier than it should"
    assert begins_s - heard_s < HEARTBEAT_S
    assert ends_s - heard_s < HEARTBEAT_S + ramp_s(80.0, rig)


async def stopped(rig: Rig, robot: ArduinoRobot) -> tuple[float, float, list[Step]]:
    """Stop from full speed; when the stop was sent and had arrived [s], and the steps of rho1."""
    async with on_the_way(robot, RIGHT):
        await asyncio.sleep(0.2)
        sent_s = simulated_s(rig, asyncio.get_running_loop().time())
        await robot.stop(StopCategory.DECELERATE_AND_HOLD)
        await sample_where(robot, lambda state: state.board is BoardState.READY)
    steps, _ = await rig.control.recorded_steps()
    return sent_s, sent_s + USB_LATENCY_S, steps


async def test_a_stop_is_obeyed_at_once(homed: tuple[Rig, ArduinoRobot]) -> None:
    rig, robot = homed
    await ready(rig, robot, LEFT)
    await rig.control.record_steps()
    sent_s, arrived_s, steps = await stopped(rig, robot)
    begins_s, ends_s = braking_begins_s(steps, sent_s), steps[-1].at_s
    print(
        f"\narrival of a stop to deceleration {(begins_s - arrived_s) * 1e3:.1f} ms, "
        f"to standstill {(ends_s - arrived_s) * 1e3:.1f} ms"
    )
    assert begins_s - arrived_s < STOP_S
    assert ends_s - arrived_s < STOP_S + ramp_s(80.0, rig)


@pytest.mark.parametrize("mm_s", [5.0, 33.3, 80.0])
async def test_segments_are_as_fast_as_they_say(
    homed: tuple[Rig, ArduinoRobot], mm_s: float
) -> None:
    rig, robot = homed
    await ready(rig, robot, LEFT)
    target = LEFT._replace(rho1_mm=LEFT.rho1_mm + 1.2 * mm_s, rho2_mm=LEFT.rho2_mm - 1.2 * mm_s)
    segments = await plan(robot, target, steady(mm_s))
    await rig.control.record_steps()
    await move(robot, target, steady(mm_s))
    rails = await rig.control.recorded_steps()
    duration_s = sum(segment.duration_s for segment in segments)
    per_mm = rig.machine.settings.rho1.units_per_mm
    for steps, way_mm in zip(rails, (1.2 * mm_s, -1.2 * mm_s), strict=True):
        middle_s = 0.5 * (steps[0].at_s + steps[-1].at_s)
        cruise = [step for step in steps if abs(step.at_s - middle_s) < 0.2]
        one_step = 1 / (cruise[-1].at_s - cruise[0].at_s)
        assert abs(speed_steps_s(cruise)) == pytest.approx(mm_s * per_mm, abs=1.5 * one_step)
        assert steps[-1].position - steps[0].position == pytest.approx(way_mm * per_mm, abs=2)
        assert steps[-1].at_s - steps[0].at_s == pytest.approx(duration_s, abs=0.05)


async def test_a_jog_stops_when_its_button_is_let_go(homed: tuple[Rig, ArduinoRobot]) -> None:
    rig, robot = homed
    await ready(rig, robot, LEFT)
    geometry = rig.machine.geometry
    garage = build_garage(
        geometry, LIMITS, CameraMount(), pi_camera_v2(), SimulationParameters(), seed=1
    )
    supervisor = Supervisor(
        robot,
        geometry,
        LIMITS,
        MemoryPlug(),
        Calendar(),
        station=garage.station,
        settings=SupervisionSettings(),
    )
    jog = Jog(supervisor)
    await supervisor.start()
    await rig.control.record_steps()
    for _ in range(10):
        jog.hold("rho1", 1, JOG_MM_S)
        await asyncio.sleep(0.1)
    released_s = simulated_s(rig, asyncio.get_running_loop().time())
    jog.release()
    await jog.wait_stopped()
    steps, _ = await rig.control.recorded_steps()
    await supervisor.close()
    await robot.connect()
    assert released_s - steps[-1].at_s < 0.01, "it was moving"
    ends_s = steps[-1].at_s
    print(f"\nbutton let go to standstill {(ends_s - released_s) * 1e3:.1f} ms")
    assert ends_s - released_s < JOG_STOP_S


async def test_a_limit_switch_ends_all_steps_within_one_tick(
    homed: tuple[Rig, ArduinoRobot],
) -> None:
    rig, robot = homed
    await ready(rig, robot, LEFT)
    await rig.control.record_steps()
    async with on_the_way(robot, RIGHT):
        opened = await rig.control.spoil_switch(2, "cut")
        await sample_where(robot, lambda state: state.fault is not None)
    rails = await rig.control.recorded_steps()
    await rig.control.spoil_switch(2, "whole")
    for steps in rails:
        assert steps[0].at_s < opened.simulated_s
        late = steps_after(steps, opened.simulated_s)
        # the tick that sees the switch still makes the step that the one before has worked out
        assert len(late) <= 1
        assert all(step.at_s - opened.simulated_s <= 1.5 * TICK_S for step in late)
