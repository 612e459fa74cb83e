"""Tests in virtual time: every wait is skipped, so nothing sleeps."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from typing import TypeVar

from server.timing import VirtualTimeLoop

T = TypeVar("T")


def run_virtual(coroutine: Awaitable[T]) -> T:
    """Run to the end in virtual time."""

    async def main() -> T:
        return await coroutine

    with asyncio.Runner(loop_factory=VirtualTimeLoop) as runner:
        return runner.run(main())


async def wait_until(condition: Callable[[], bool], timeout_s: float = 30.0) -> float:
    """Let virtual time pass, in steps of 1 ms, until a condition holds; returns how long it took.

    Raises:
        TimeoutError: it does not hold within that time.
    """
    loop = asyncio.get_running_loop()
    began_s = loop.time()
    while not condition():
        if loop.time() - began_s > timeout_s:
            raise TimeoutError(f"not within {timeout_s} s")
        await asyncio.sleep(0.001)
    return loop.time() - began_s


async def oversleep(duration_s: float) -> None:
    """Let virtual time jump without anybody getting a turn, as on a computer that is too busy."""
    loop = asyncio.get_running_loop()
    assert isinstance(loop, VirtualTimeLoop)
    loop._skipping.now_s += duration_s
    await asyncio.sleep(0)
