from __future__ import annotations

import asyncio

import pytest

from server.control.finishing import finish
from tests.support.virtual import run_virtual


async def _work(done: list[str], error: Exception | None = None) -> str:
    await asyncio.sleep(1.0)
    done.append("done")
    if error is not None:
        raise error
    return "result"


def test_it_hands_out_results_and_errors() -> None:
    done: list[str] = []
    assert run_virtual(finish(_work(done))) == "result"
    with pytest.raises(ZeroDivisionError):
        run_virtual(finish(_work(done, ZeroDivisionError())))
    assert done == ["done", "done"]


@pytest.mark.parametrize("error", [None, ZeroDivisionError()])
def test_work_is_done_before_a_cancellation_takes_effect(error: Exception | None) -> None:
    async def scenario() -> None:
        done: list[str] = []
        task = asyncio.create_task(finish(_work(done, error)))
        for _ in range(5):
            await asyncio.sleep(0.15)
            task.cancel()
        await asyncio.sleep(0.2)
        assert not task.done()
        await asyncio.wait([task])
        assert task.cancelled()
        assert done == ["done"]

    run_virtual(scenario())
