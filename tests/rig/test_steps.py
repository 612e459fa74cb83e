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
    TICK_HZ,
    Heartbeat,
    Segment,
    Telemetry,
    TelemetryFlag,
)
from drivers.arduino.steps import phase, segment_end, whole
from tests.rig.build import Programs
from tests.rig.chains import compare_random_groups
from tests.rig.raw import RawBoard, raw_board
from tests.rig.rig import running_rig

pytestmark = pytest.mark.asyncio(loop_scope="module")

GROUPS = 20
"""Of sixteen segments."""

LARGEST_LOAD = 0.35
"""Of the processor, by the step interrupt."""

HALF_RATE = 1 << 30
"""10 000 steps a second."""

WORK_SEGMENTS = 12
TAKEN_S = 0.08
"""In which the board must take them."""

FLOOD_PERIOD_S = 1e-3
FLOOD_FRAMES = 3
"""Heartbeats every millisecond: six times what the host ever says."""


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


async def test_a_flood_of_bytes_at_full_work_makes_no_tick_late(board: RawBoard) -> None:
    loop, rig, end = asyncio.get_running_loop(), board.rig, board.rig.cable.end
    assert end is not None
    start = board.newest
    sent_s = loop.time()
    await board.connection.command(*full_work(start))
    taken_s = loop.time() - sent_s
    assert board.newest.bad_frames == start.bad_frames, "a burst of segments was not lost"
    before = await rig.control.statistics()
    await rig.control.forget()
    flood = encode_frame(Frame(0, 0, Heartbeat())) * FLOOD_FRAMES
    for _ in range(1000):
        end.write(flood)
        await asyncio.sleep(FLOOD_PERIOD_S)
    after = await rig.control.statistics()
    sample = board.newest
    received = after.bytes_to_board - before.bytes_to_board
    print(
        f"\n2 x 10 000 steps/s and {received} bytes/s: step interrupt {after.tick_share:.1%} of "
        f"the CPU, longest {after.longest_tick_us:.1f} us; awake {after.awake_share:.1%}; "
        f"longest round of the slide's loop {after.longest_round_us / 1000:.2f} ms; "
        f"{WORK_SEGMENTS} segments taken in {taken_s * 1e3:.0f} ms"
    )
    assert taken_s < TAKEN_S
    assert received > 24_000
    assert abs(after.ticks - TICK_HZ) <= 2
    assert all(abs(rail.steps - TICK_HZ // 2) <= 2 for rail in after.rails)
    assert after.late_ticks == 0
    assert after.tick_share < LARGEST_LOAD
    assert after.overruns == 0
    assert sample.bad_frames == start.bad_frames
    assert not TelemetryFlag(sample.flags) & (TelemetryFlag.LATE_TICK | TelemetryFlag.RX_OVERRUN)
