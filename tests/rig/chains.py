"""Random segments, and every step that they ask of the carriages."""

from __future__ import annotations

import asyncio
import random
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from drivers.arduino.protocol import messages
from drivers.arduino.protocol.messages import MAX_SEGMENT_TICKS, QUEUE_CAPACITY
from drivers.arduino.steps import Triple, WirePoint, phase, segment_end, whole
from tests.rig.machine import Machine
from tests.rig.raw import RawBoard

MAX_RATE = 2**31 - 1
STEP_AXES = 2
NUMBERS = 1 << 16

LARGEST_JUMP = round(0.98 * MAX_RATE)
"""Between two segments of a carriage: what ANY_JUMP_MM_S allows, rounded down."""

RESTS = 3
"""A group begins with rests of 100 ms, while the other segments get into the queue."""

SHORE_UNITS = 3000
"""Chains keep this far from the ends of the travel: they may turn round inside a segment."""

SLIDE_RATE = 40_000_000
"""Of rho3: 4 mm/s, so that the motor can follow a random chain."""

STILL: Triple = (0, 0, 0)


class TickedStep(NamedTuple):
    """A step: the tick whose interrupt makes it, and where it leads."""

    tick: int
    position: int


class RandomSegments:
    """Segments of any rates, accelerations and durations that a board accepts.

    Args:
        machine: Gives the travel.
        seed: Decides them.
    """

    def __init__(self, machine: Machine, seed: int) -> None:
        self._rng = random.Random(seed)
        self._travel = [
            (joint.min_mm * axis.units_per_mm, joint.max_mm * axis.units_per_mm)
            for joint, axis in zip(
                machine.geometry.joint_ranges, machine.settings.axes, strict=True
            )
        ]

    def group(self, start: Triple, number: int) -> list[messages.Segment]:
        """As many as a queue holds, rests first.

        Args:
            start: Fixed-point positions at which the board rests.
            number: The first segment's.
        """
        group: list[messages.Segment] = []
        end = WirePoint(start, STILL)
        while len(group) < QUEUE_CAPACITY:
            if len(group) < RESTS:
                segment = _segment(number, end.position, MAX_SEGMENT_TICKS, [(0, 0)] * 3)
            else:
                ticks = self._rng.randint(1, self._rng.choice([3, 50, 400, MAX_SEGMENT_TICKS]))
                # the last one must end slowly enough to be a rest
                fastest = MAX_RATE if len(group) < QUEUE_CAPACITY - 1 else LARGEST_JUMP
                motion = [self._motion(axis, end, ticks, fastest) for axis in range(3)]
                segment = _segment(number, end.position, ticks, motion)
            group.append(segment)
            end = segment_end(segment)
            number = (number + 1) % NUMBERS
        return group

    def _motion(self, axis: int, end: WirePoint, ticks: int, fastest: int) -> tuple[int, int]:
        """A rate and an acceleration that lead away from a near end of the travel."""
        bound = SLIDE_RATE
        if axis < STEP_AXES:
            bound = min(fastest, self._rng.choice([MAX_RATE, MAX_RATE, 1 << 24, 0]))
        rate, last = self._rng.randint(-bound, bound), self._rng.randint(-bound, bound)
        lowest, highest = self._travel[axis]
        at = whole(end.position[axis])
        beyond = not lowest + SHORE_UNITS < at < highest - SHORE_UNITS
        if beyond and (rate + last > 0) == (at > 0.5 * (lowest + highest)):
            rate, last = -rate, -last
        before = end.rate[axis]
        rate = min(max(rate, before - LARGEST_JUMP), before + LARGEST_JUMP)
        # With jumps so large most ends count as rests, and a segment behind a rest begins from 0.
        rate = min(max(rate, -LARGEST_JUMP), LARGEST_JUMP)
        return rate, min(max(int((last - rate) / ticks), -MAX_RATE), MAX_RATE)


def steps_of(group: Sequence[messages.Segment], axis: int, began_tick: int) -> list[TickedStep]:
    """Every step that a group asks of a carriage.

    Args:
        group: Segments, one after the other.
        axis: 0 or 1.
        began_tick: Ticks that were done when the first segment began.
    """
    steps: list[TickedStep] = []
    for segment in group:
        n = np.arange(segment.ticks + 1, dtype=np.int64)
        start = (segment.start[axis] << messages.PHASE_BITS) + segment.phase[axis]
        position = start + n * segment.rate[axis] + segment.acceleration[axis] * (n * (n - 1) // 2)
        units = position >> messages.PHASE_BITS
        changed = np.flatnonzero(np.diff(units)) + 1
        # the interrupt after the tick that has worked a step out makes it
        steps += [TickedStep(began_tick + int(k) + 1, int(units[k])) for k in changed]
        began_tick += segment.ticks
    return steps


async def compare_random_groups(board: RawBoard, groups: int, seed: int) -> int:
    """Let the board follow random segments, and compare each step with the host's prediction.

    Returns:
        How many steps were compared.
    """
    chance = RandomSegments(board.rig.machine, seed)
    rested, truth = board.newest, await board.rig.control.state()
    shift = (truth.rho1_steps - rested.commanded[0], truth.rho2_steps - rested.commanded[1])
    position, number = _middles(rested.commanded), rested.next_segment
    expected: tuple[list[TickedStep], list[TickedStep]] = ([], [])
    await board.rig.control.record_steps()
    for _ in range(groups):
        group = chance.group(position, number)
        began = await board.follow(group)
        for axis in range(STEP_AXES):
            expected[axis].extend(steps_of(group, axis, began))
        position, number = segment_end(group[-1]).position, (group[-1].number + 1) % NUMBERS
        await asyncio.sleep(0.02)
        assert tuple(map(whole, position)) == board.newest.commanded
    for axis, steps in enumerate(await board.rig.control.recorded_steps()):
        made = [TickedStep(step.tick, step.position - shift[axis]) for step in steps]
        assert made == expected[axis], f"rho{axis + 1}: {_first_difference(made, expected[axis])}"
    return sum(map(len, expected))


def _middles(units: Triple) -> Triple:
    half = 1 << (messages.PHASE_BITS - 1)
    one, two, three = ((whole << messages.PHASE_BITS) + half for whole in units)
    return one, two, three


def _segment(
    number: int, start: Triple, ticks: int, motion: Sequence[tuple[int, int]]
) -> messages.Segment:
    (rate1, acceleration1), (rate2, acceleration2), (rate3, acceleration3) = motion
    return messages.Segment(
        number=number,
        ticks=ticks,
        start=(whole(start[0]), whole(start[1]), whole(start[2])),
        phase=(phase(start[0]), phase(start[1]), phase(start[2])),
        rate=(rate1, rate2, rate3),
        acceleration=(acceleration1, acceleration2, acceleration3),
    )


def _first_difference(made: list[TickedStep], expected: list[TickedStep]) -> str:
    for index, (a, b) in enumerate(zip(made, expected, strict=False)):
        if a != b:
            return f"step {index} is {a}, expected {b}"
    return f"{len(made)} steps, expected {len(expected)}"
