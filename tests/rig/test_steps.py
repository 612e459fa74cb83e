"""Every single step of the real firmware against the host's prediction."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator

import pytest
import pytest_asyncio

from drivers.arduino.link.frames import Frame, encode_frame
from drivers.arduino.protocol.messages import (
    MAX_SEGMENT_TICKS,
    PHASE_BITS,
    RETRANSMIT_MS,
    WINDOW,
    Fault,
    Heartbeat,
    Segment,
    State,
    Telemetry,
    TelemetryFlag,
)
from drivers.arduino.steps import phase, segment_end, whole
from tests.rig.build import Programs
from tests.rig.chains import compare_random_groups
from tests.rig.raw import RawBoard, raw_board
from tests.rig.rig import Rig, running_rig
from tests.rig.truth import Statistics

pytestmark = pytest.mark.asyncio(loop_scope="module")

GROUPS = 20
"""Of sixteen segments."""

LARGEST_LOAD = 0.35
"""Of the processor, by the step interrupt."""

LONGEST_INTERVAL_US = 70.0
"""Between two ticks, nominally 50: the encoder has the right of way, and short locks of the main
loop come on top. Late is a tick from 75 on; lost from 100 on."""

HALF_RATE = 1 << 30
"""10 000 steps a second."""

WORK_SEGMENTS = 12
TAKEN_S = 0.08
"""In which the board must take them."""


@pytest_asyncio.fixture(scope="module", loop_scope="module")
async def board(programs: Programs) -> AsyncIterator[RawBoard]:
    """Homed once for all tests of this file."""
    async with running_rig(programs) as rig, raw_board(rig) as board:
        yield board


async def test_every_step_of_random_segments_is_where_the_host_expects_it(
    board: RawBoard,
) -> None:
    steps = await compare_random_groups(board, GROUPS, seed=1)
    statistics = await board.rig.control.statistics()
    print(f"\n{steps} steps of {16 * GROUPS} segments, each in its tick")
    assert steps > 20_000
    assert all(rail.lost == 0 for rail in statistics.rails)


def full_work(start: Telemetry) -> list[Segment]:
    """Both carriages at 10 000 steps a second, for more than a second."""
    work: list[Segment] = []
    at = tuple((units << PHASE_BITS) + HALF_RATE for units in start.commanded)
    while len(work) < WORK_SEGMENTS:
        one, two, three = at
        work.append(
            Segment(
                number=start.next_segment + len(work),
                ticks=MAX_SEGMENT_TICKS,
                start=(whole(one), whole(two), whole(three)),
                phase=(phase(one), phase(two), phase(three)),
                rate=(HALF_RATE, -HALF_RATE, 0),
                acceleration=(0, 0, 0),
            )
        )
        at = segment_end(work[-1]).position
    return work


async def flood(rig: Rig, burst: bytes, period_s: float, bursts: int) -> Statistics:
    """Say something over and over; what that was like for the board."""
    assert rig.cable.end is not None
    before = await rig.control.statistics()
    await rig.control.forget()
    for _ in range(bursts):
        rig.cable.end.write(burst)
        await asyncio.sleep(period_s)
    after = await rig.control.statistics()
    print(
        f"\n2 x 10 000 steps/s and "
        f"{(after.bytes_to_board - before.bytes_to_board) / (period_s * bursts):.0f} bytes/s: "
        f"step interrupt {after.tick_share:.1%} of the CPU, longest {after.longest_tick_us:.1f} us;"
        f" longest interval {after.tick_interval_us[1]:.1f} us; awake {after.awake_share:.1%}; "
        f"longest round of the slide's loop {after.longest_round_us / 1000:.2f} ms"
    )
    return after


async def test_a_flood_of_bytes_at_full_work_disturbs_no_tick(board: RawBoard) -> None:
    loop, rig = asyncio.get_running_loop(), board.rig
    start = board.newest
    work = full_work(start)
    sent_s = loop.time()
    await board.connection.command(*work)
    taken_s = loop.time() - sent_s
    print(f"\n{WORK_SEGMENTS} segments taken in {taken_s * 1e3:.0f} ms")
    assert taken_s < TAKEN_S

    # as bad as the host can do it: a whole window of old segments, sent again all the time
    old = Frame((rig.heard[-1].frame.ack + 100) % 256, 0, work[0])
    again = await flood(rig, encode_frame(old) * WINDOW, RETRANSMIT_MS / 1000, bursts=20)
    await asyncio.sleep(0.03)
    sample = board.newest
    assert all(abs(rail.steps - again.ticks / 2) <= 2 for rail in again.rails), (
        "both were at full work"
    )
    assert again.late_ticks == 0
    assert again.tick_interval_us[1] < LONGEST_INTERVAL_US
    assert again.tick_share < LARGEST_LOAD
    assert again.overruns == 0
    assert sample.bad_frames == start.bad_frames
    assert not TelemetryFlag(sample.flags) & (TelemetryFlag.LATE_TICK | TelemetryFlag.RX_OVERRUN)

    # nonsense, faster than anybody could read it: what is lost is lost, but nothing else suffers
    nonsense = await flood(rig, encode_frame(Frame(0, 0, Heartbeat())) * 5, 0.001, bursts=300)
    assert nonsense.late_ticks == 0
    assert nonsense.tick_interval_us[1] < LONGEST_INTERVAL_US
    assert nonsense.tick_share < LARGEST_LOAD
    assert board.newest.state == State.RUN
    assert board.newest.fault == Fault.NONE
