"""Clears Python's memory of unreachable objects while the robot stands.

A full pass of the garbage collector over everything that vision and the twin have loaded takes
a tenth of a second, in which nothing else runs: no stop, no feeding of the motion queue. So it
never starts by itself. The two young generations, a millisecond or two, stay automatic.
"""

from __future__ import annotations

import asyncio
import contextlib
import gc
import sys
from collections.abc import AsyncIterator, Callable

EVERY_S = 60.0
NEVER = 1_000_000_000


@contextlib.asynccontextmanager
async def tidying_at_rest(at_rest: Callable[[], bool]) -> AsyncIterator[None]:
    """As long as this is entered, full passes happen at rest only, and are short.

    Args:
        at_rest: Whether the robot stands now and nothing is about to move it.
    """
    young, middle, old = gc.get_threshold()
    gc.set_threshold(young, middle, NEVER)
    tidying = asyncio.create_task(_tidy(at_rest))
    try:
        yield
    finally:
        tidying.cancel()
        gc.set_threshold(young, middle, old)
        gc.unfreeze()


async def _tidy(at_rest: Callable[[], bool]) -> None:
    modules_set_aside = 0
    while True:
        if at_rest():
            gc.collect()
            # Modules that are loaded stay: no later pass needs to look at what they brought.
            if len(sys.modules) != modules_set_aside:
                modules_set_aside = len(sys.modules)
                gc.freeze()
        await asyncio.sleep(EVERY_S)
