"""Real motion: what the host wants, what the firmware says, and what the motors did."""

from __future__ import annotations

import asyncio
from itertools import pairwise

import pytest

from drivers.arduino.driver import ArduinoRobot
from drivers.robot import BoardState, FaultCode, NotConnectedError, StopCategory
from tests.rig.host import (
    FAR,
    LIMITS,
    NEAR,
    at_rest,
    move,
    on_the_way,
    ready,
    release,
    sample_where,
)
from tests.rig.rig import Rig
from tests.rig.truth import TrueState
from tests.support.eventually import eventually

pytestmark = pytest.mark.asyncio(loop_scope="module")


RAIL_MM = 0.02
"""Homing looks at the switches once a millisecond, at 5 mm/s; and rounding to microsteps."""

SLIDE_MM = 0.05
"""What the slide's loop calls settled, at both ends."""

PULSE_US = 2.0
SET_UP_US = 1.0
"""What stepper drivers want: the DRV8825 1.9 us high, both kinds less than 1 us of set-up."""

HEARTBEAT_S = 0.25
"""Longest time from a dead link to the beginning of the stop."""


async def expect_stand(rig: Rig, robot: ArduinoRobot) -> None:
    """What the board says about the joints is where they are."""
    state = await at_rest(robot)
    truth = await rig.true_joints()
    reported = state.measured.position
    assert reported.rho1_mm == pytest.approx(truth.rho1_mm, abs=RAIL_MM)
    assert reported.rho2_mm == pytest.approx(truth.rho2_mm, abs=RAIL_MM)
    assert reported.rho3_mm == pytest.approx(truth.rho3_mm, abs=SLIDE_MM)


async def test_homing_finds_the_true_places(homed: tuple[Rig, ArduinoRobot]) -> None:
    rig, robot = homed
    await expect_stand(rig, robot)
    assert (await at_rest(robot)).homed


async def test_every_step_is_made_cleanly_and_in_time(homed: tuple[Rig, ArduinoRobot]) -> None:
    rig, robot = homed
    await ready(rig, robot, NEAR)
    before = await rig.control.state()
    reached = await move(robot, FAR)
    after = await rig.control.state()
    statistics = await rig.control.statistics()

    assert reached.fault is None
    assert reached.commanded.position == pytest.approx(FAR, abs=RAIL_MM)
    await expect_stand(rig, robot)
    made = (after.rho1_steps - before.rho1_steps, after.rho2_steps - before.rho2_steps)
    per_mm = rig.machine.settings.rho1.units_per_mm
    assert made[0] == pytest.approx((FAR.rho1_mm - NEAR.rho1_mm) * per_mm, abs=2)
    assert made[1] == pytest.approx((FAR.rho2_mm - NEAR.rho2_mm) * per_mm, abs=2)
    for rail, net in zip(statistics.rails, made, strict=True):
        assert rail.steps == abs(net), "no step forth and back"
        assert rail.lost == 0
        assert rail.shortest_pulse_us >= PULSE_US
        assert rail.shortest_set_up_us == 0 or rail.shortest_set_up_us >= SET_UP_US
    assert statistics.late_ticks == 0
    assert statistics.overruns == 0


async def test_a_bad_cable_changes_no_step(homed: tuple[Rig, ArduinoRobot]) -> None:
    rig, robot = homed
    await ready(rig, robot, NEAR)
    await rig.control.spoil_link(lose=2e-4, flip=2e-4, duplicate=1e-4)
    try:
        reached = await move(robot, FAR)
    finally:
        await rig.control.spoil_link()
    spoilt = await rig.control.statistics()
    assert spoilt.lost > 0
    assert spoilt.flipped > 0
    assert spoilt.duplicated > 0
    assert reached.fault is None
    assert reached.commanded.position == pytest.approx(FAR, abs=RAIL_MM)
    await expect_stand(rig, robot)


async def test_a_stop_comes_to_rest_and_loses_no_step(homed: tuple[Rig, ArduinoRobot]) -> None:
    rig, robot = homed
    await ready(rig, robot, NEAR)
    async with on_the_way(robot, FAR):
        began_s = asyncio.get_running_loop().time()
        await robot.stop(StopCategory.DECELERATE_AND_HOLD)
        heard_s = asyncio.get_running_loop().time() - began_s
        stopped = await at_rest(robot)
    assert heard_s < 0.05
    assert stopped.board is BoardState.READY
    assert stopped.homed
    assert (await rig.control.state()).power
    await expect_stand(rig, robot)


async def test_a_limit_switch_ends_the_steps_within_one_tick(
    homed: tuple[Rig, ArduinoRobot],
) -> None:
    rig, robot = homed
    await ready(rig, robot, NEAR)
    async with on_the_way(robot, FAR):
        cut = await rig.control.spoil_switch(1, "cut")
        stopped = await sample_where(robot, lambda state: state.fault is not None)
        later = await rig.control.state()
    await rig.control.spoil_switch(1, "whole")
    assert stopped.fault is not None
    assert stopped.fault.code is FaultCode.LIMIT_SWITCH
    assert abs(later.rho1_steps - cut.rho1_steps) <= 1
    assert abs(later.rho2_steps - cut.rho2_steps) <= 1


async def test_the_emergency_stop_button_cuts_power_and_latches(
    homed: tuple[Rig, ArduinoRobot],
) -> None:
    rig, robot = homed
    await ready(rig, robot, NEAR)
    async with on_the_way(robot, FAR):
        assert not (await rig.control.press_stop_button()).power
        stopped = await sample_where(robot, lambda state: state.fault is not None)
    await rig.control.press_stop_button(pressed=False)
    assert stopped.fault is not None
    assert stopped.fault.code is FaultCode.EMERGENCY_STOP
    await release(robot)
    assert not (await rig.control.state()).relay
    await robot.enable()
    # carriages went on without power, so nobody knows where they are
    await robot.home()
    await expect_stand(rig, robot)


async def test_a_jammed_slide_stalls(homed: tuple[Rig, ArduinoRobot]) -> None:
    rig, robot = homed
    await ready(rig, robot, NEAR)
    async with on_the_way(robot, FAR):
        await rig.control.jam()
        stopped = await sample_where(robot, lambda state: state.fault is not None)
    await rig.control.jam(jammed=False)
    assert stopped.fault is not None
    assert stopped.fault.code in {FaultCode.STALL, FaultCode.FOLLOWING_ERROR}


async def test_a_dead_encoder_is_noticed_before_the_slide_runs_away(
    homed: tuple[Rig, ArduinoRobot],
) -> None:
    rig, robot = homed
    await ready(rig, robot, NEAR)
    async with on_the_way(robot, FAR):
        dead = await rig.control.kill_encoder()
        stopped = await sample_where(robot, lambda state: state.fault is not None)
        await at_rest(robot)
        later = await rig.control.state()
    await rig.control.kill_encoder(dead=False)
    await release(robot)
    await robot.enable()
    await robot.home()
    assert stopped.fault is not None
    assert stopped.fault.code in {FaultCode.STALL, FaultCode.FOLLOWING_ERROR}
    assert abs(later.rho3_mm - dead.rho3_mm) < 10.0


async def test_a_dead_link_stops_the_robot_by_itself(homed: tuple[Rig, ArduinoRobot]) -> None:
    rig, robot = homed
    await ready(rig, robot, NEAR)
    samples: list[TrueState] = []
    rig.control.on_sample(samples.append)
    async with on_the_way(robot, FAR):
        cut = await rig.control.unplug()
        await eventually(lambda: not samples[-1].relay)
    moving = [
        later.simulated_s
        for earlier, later in pairwise(samples)
        if later.rho1_steps != earlier.rho1_steps or later.rho2_steps != earlier.rho2_steps
    ]
    deceleration_s = max(limit.velocity_mm_s for limit in LIMITS.joints) / 1500.0
    assert moving[-1] - cut.simulated_s < HEARTBEAT_S + deceleration_s
    with pytest.raises(NotConnectedError):
        await robot.stop(StopCategory.DECELERATE_AND_HOLD)

    await rig.control.plug_in()
    await robot.connect()
    state = await at_rest(robot)
    assert state.board is BoardState.IDLE
    assert not state.homed, "opening the port has reset the board"
