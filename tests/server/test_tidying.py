"""Full passes of the garbage collector: at rest, and at no other time."""

from __future__ import annotations

import asyncio
import gc
import weakref
from collections.abc import Iterator

import pytest

from server.tidying import EVERY_S, tidying_at_rest
from server.timing import VirtualTimeLoop


class Knot:
    """Reaches itself, so that only the collector can clear it away."""

    def __init__(self) -> None:
        self.itself = self


@pytest.fixture(autouse=True)
def as_it_was() -> Iterator[None]:
    before = gc.get_threshold()
    yield
    assert gc.get_threshold() == before
    assert gc.get_freeze_count() == 0


def grown_old() -> weakref.ref[Knot]:
    """A knot that the two young generations have passed on."""
    knot = Knot()
    gc.collect(1)
    gc.collect(1)
    return weakref.ref(knot)


async def later(delay_s: float) -> None:
    await asyncio.sleep(delay_s)


@pytest.mark.parametrize("resting", [True, False])
def test_what_is_unreachable_goes_at_rest_only(resting: bool) -> None:
    async def scenario() -> None:
        now_resting = False
        async with tidying_at_rest(lambda: now_resting):
            await later(1.0)
            knot = grown_old()
            now_resting = resting
            await later(EVERY_S)
            assert (knot() is None) is resting

    with asyncio.Runner(loop_factory=VirtualTimeLoop) as runner:
        runner.run(scenario())


def test_no_full_pass_begins_by_itself() -> None:
    passes: list[int] = []

    def note(phase: str, info: dict[str, int]) -> None:
        if phase == "start":
            passes.append(info["generation"])

    async def scenario() -> None:
        async with tidying_at_rest(lambda: False):
            gc.callbacks.append(note)
            try:
                kept = [[Knot() for _ in range(10)] for _ in range(60_000)]
            finally:
                gc.callbacks.remove(note)
            assert kept

    with asyncio.Runner(loop_factory=VirtualTimeLoop) as runner:
        runner.run(scenario())
    assert 1 in passes
    assert 2 not in passes
