from __future__ import annotations

import asyncio
import threading
import time
from datetime import UTC, datetime, timedelta

import pytest

from server.timing import Calendar, NothingLeftToWaitForError, ScaledTimeLoop
from tests.support.virtual import oversleep, run_virtual


def test_virtual_time_skips_every_wait_and_keeps_the_order() -> None:
    async def scenario() -> list[tuple[str, float]]:
        loop = asyncio.get_running_loop()
        seen: list[tuple[str, float]] = []

        async def sleeper(name: str, delay_s: float) -> None:
            await asyncio.sleep(delay_s)
            seen.append((name, loop.time()))

        await asyncio.gather(
            sleeper("year", 365 * 86400.0),
            sleeper("tick", 0.001),
            sleeper("hour", 3600.0),
            sleeper("now", 0.0),
        )
        return seen

    began_s = time.perf_counter()
    seen = run_virtual(scenario())
    assert [name for name, _ in seen] == ["now", "tick", "hour", "year"]
    assert [at_s for _, at_s in seen] == pytest.approx([0.0, 0.001, 3600.0, 365 * 86400.0])
    assert time.perf_counter() - began_s < 2.0


def test_timeouts_take_virtual_time() -> None:
    async def scenario() -> float:
        with pytest.raises(TimeoutError):
            async with asyncio.timeout(1000.0):
                await asyncio.Event().wait()
        return asyncio.get_running_loop().time()

    assert run_virtual(scenario()) == pytest.approx(1000.0)


def test_work_for_threads_is_done_at_once_in_virtual_time() -> None:
    async def scenario() -> None:
        loop = asyncio.get_running_loop()
        caller = threading.get_ident()
        before_s = loop.time()
        order: list[int] = []
        await asyncio.gather(*(asyncio.to_thread(order.append, number) for number in range(5)))
        assert order == list(range(5))
        assert await asyncio.to_thread(threading.get_ident) == caller
        assert loop.time() == before_s
        with pytest.raises(ZeroDivisionError):
            await asyncio.to_thread(lambda: 1 // 0)

    run_virtual(scenario())


def test_waiting_for_what_can_never_happen_is_an_error_not_a_hang() -> None:
    async def scenario() -> None:
        await asyncio.Event().wait()

    with pytest.raises(NothingLeftToWaitForError):
        run_virtual(scenario())


def test_a_busy_computer_makes_timers_late_and_none_is_lost() -> None:
    async def scenario() -> list[float]:
        loop = asyncio.get_running_loop()
        fired: list[float] = []
        for number in range(1, 6):
            loop.call_later(0.1 * number, lambda: fired.append(loop.time()))
        await oversleep(0.35)
        await asyncio.sleep(1.0)
        return fired

    assert run_virtual(scenario()) == pytest.approx([0.35, 0.35, 0.35, 0.4, 0.5])


def test_two_virtual_runs_are_the_same() -> None:
    async def scenario() -> list[float]:
        loop = asyncio.get_running_loop()
        times: list[float] = []
        for number in range(1, 200):
            await asyncio.sleep(1.0 / number)
            times.append(loop.time())
        return times

    assert run_virtual(scenario()) == run_virtual(scenario())


@pytest.mark.parametrize("speed", [0.5, 50.0])
def test_scaled_time_runs_as_much_faster_as_it_says(speed: float) -> None:
    async def scenario() -> float:
        loop = asyncio.get_running_loop()
        before_s = loop.time()
        await asyncio.sleep(0.04 * speed)
        return loop.time() - before_s

    began_s = time.monotonic()
    with asyncio.Runner(loop_factory=lambda: ScaledTimeLoop(speed)) as runner:
        slept_s = runner.run(scenario())
    took_s = time.monotonic() - began_s
    # the loop's clock and the wall's agree, however long the computer was busy
    assert 0.04 * speed <= slept_s + 1e-6
    assert slept_s <= took_s * speed
    assert took_s >= 0.04


def test_threads_wake_a_scaled_loop() -> None:
    async def scenario() -> int:
        return await asyncio.wait_for(asyncio.to_thread(lambda: 42), 1000.0)

    with asyncio.Runner(loop_factory=lambda: ScaledTimeLoop(20.0)) as runner:
        assert runner.run(scenario()) == 42


def test_the_calendar_turns_loop_times_into_dates() -> None:
    async def scenario() -> None:
        calendar = Calendar()
        loop = asyncio.get_running_loop()
        start = calendar.now()
        assert abs(start - datetime.now(UTC)) < timedelta(seconds=5)
        assert start.tzinfo is UTC
        await asyncio.sleep(90.0)
        assert (calendar.now() - start).total_seconds() == pytest.approx(90.0)
        assert (calendar.at(loop.time() - 30.0) - start).total_seconds() == pytest.approx(60.0)

    run_virtual(scenario())


def test_dates_stay_the_walls_when_the_loop_runs_faster() -> None:
    with asyncio.Runner(loop_factory=lambda: ScaledTimeLoop(10.0)) as runner:
        loop = runner.get_loop()
        calendar = Calendar(speed=10.0, loop=loop)
        before = calendar.at(loop.time() - 100.0)
        assert (calendar.now() - before).total_seconds() == pytest.approx(10.0, abs=0.5)
        assert abs(calendar.now() - datetime.now(UTC)) < timedelta(seconds=0.5)
