"""How quickly a hand is obeyed: `python -m tests.bench.hand [ROUNDS]`.

The real server, its simulated robot at the pace of a real one, and a Chromium on the same machine.
Each time is taken from the event in the browser's page to the command for the motion board leaving
the server. All processes of one machine share one monotonic clock; how the page's clock lies
beside it is measured before every round, and half of that round trip is the error.

- stop: a pointer goes down on Stop, until the stop leaves;
- release: the pointer leaves a held jog button, until the stop of the motion leaves;
- kill: the browser's processes are killed (SIGKILL) while a button is held, until the same.
"""

from __future__ import annotations

import asyncio
import contextlib
import os
import signal
import statistics
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

from playwright.async_api import Browser, Page, async_playwright, expect

from drivers.robot import StopCategory
from server.api.app import create_app
from server.api.gate.caller import cookie_name
from server.composition import running
from server.config.settings import Settings
from server.config.simulation import SimulationSettings
from server.control.errors import ControlError
from server.control.model import RobotMode
from server.services import Services
from server.simulation import park_first
from tests.support.chromium import EXECUTABLE, FLAT
from tests.support.fake_stations.serving import serving
from tests.support.pairing import new_device

ROUNDS = 100
KILLS = 10
HELD_S, QUIET_S, STEP_S = 0.25, 0.5, 0.1
PATIENCE_S = 15.0
TARGETS_MS = {"stop": 30.0, "release": 30.0, "kill": 200.0}
WATCH = """() => {
  window.handTimes = [];
  for (const kind of ["pointerdown", "pointerup"])
    addEventListener(kind, (event) => window.handTimes.push([kind, event.timeStamp]), true);
}"""


class _Departures:
    """Notes when stops leave for the motion board."""

    def __init__(self, services: Services) -> None:
        self._driver = services.supervisor._driver
        self._stop = self._driver.stop
        self.left = asyncio.Event()
        self.at_s = 0.0
        self._driver.stop = self._note  # type: ignore[method-assign]  # the last thing before the wire

    async def _note(self, category: StopCategory) -> None:
        if not self.left.is_set():
            self.at_s = time.monotonic()
            self.left.set()
        await self._stop(category)

    def expect(self) -> None:
        """The next one counts."""
        self.left.clear()

    async def wait(self) -> float:
        """When it left [s], monotonic."""
        async with asyncio.timeout(PATIENCE_S):
            await self.left.wait()
        return self.at_s


def main() -> None:
    """Measure and print."""
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else ROUNDS
    with tempfile.TemporaryDirectory() as folder:
        times = asyncio.run(_measure(Path(folder), rounds))
    print(f"{'ms':<12}{'median':>8}{'p95':>8}{'p99':>8}{'max':>8}  target")
    for name, values in times.items():
        print(
            f"{name:<12}{statistics.median(values):>8.1f}{_part(values, 0.95):>8.1f}"
            f"{_part(values, 0.99):>8.1f}{max(values):>8.1f}  p99 < {TARGETS_MS[name]:g}"
            f"  ({len(values)} times)"
        )


async def _measure(folder: Path, rounds: int) -> dict[str, list[float]]:
    settings = Settings(simulation=SimulationSettings(speed=1.0))
    async with running(settings, folder=folder) as services:
        await park_first(services)
        app = create_app(lambda: contextlib.nullcontext(services))
        app.state.services = services
        departures = _Departures(services)
        async with serving(app) as url, async_playwright() as playwright:
            cookie = await new_device(services.access)

            async def opened() -> tuple[Browser, Page]:
                browser = await playwright.chromium.launch(executable_path=EXECUTABLE, args=FLAT)
                page = await browser.new_page()
                host = url.removeprefix("http://")
                name = cookie_name({"host": host}, "http")
                await page.context.add_cookies([{"name": name, "value": cookie, "url": url}])
                await page.goto(f"{url}/technician")
                await page.evaluate(WATCH)
                return browser, page

            browser, page = await opened()
            found: dict[str, list[float]] = {"release": [], "stop": [], "kill": []}
            for number in range(rounds):
                found["release"].append(await _release(page, departures, services, number))
                found["stop"].append(await _stop(page, departures, services))
            await browser.close()
            for number in range(min(KILLS, rounds)):
                browser, page = await opened()
                found["kill"].append(await _kill(page, departures, services, number))
                with contextlib.suppress(Exception):
                    await browser.close()
            return found


async def _release(page: Page, departures: _Departures, services: Services, number: int) -> float:
    offset_s = await _clock_offset(page)
    await _hold(page, departures, services, number)
    await page.mouse.up()
    at_s = await departures.wait()
    pressed_s = await _event_s(page, "pointerup", offset_s)
    await services.jog.wait_stopped()
    return 1000 * (at_s - pressed_s)


async def _stop(page: Page, departures: _Departures, services: Services) -> float:
    offset_s = await _clock_offset(page)
    await page.get_by_role("button", name="Stop", exact=True).hover()
    departures.expect()
    await page.mouse.down()
    at_s = await departures.wait()
    pressed_s = await _event_s(page, "pointerdown", offset_s)
    await page.mouse.up()
    await _make_ready(services)
    return 1000 * (at_s - pressed_s)


async def _make_ready(services: Services) -> None:
    """Release the stop; a busy page may have sent a second one by the other way meanwhile."""
    quiet_s = 0.0
    while quiet_s < QUIET_S:
        await asyncio.sleep(STEP_S)
        if services.supervisor.mode is RobotMode.READY:
            quiet_s += STEP_S
        else:
            quiet_s = 0.0
            with contextlib.suppress(ControlError):
                await services.supervisor.reset()


async def _kill(page: Page, departures: _Departures, services: Services, number: int) -> float:
    await _hold(page, departures, services, number)
    killed_s = time.monotonic()
    for process in _browser_processes():
        with contextlib.suppress(ProcessLookupError):
            os.kill(process, signal.SIGKILL)
    at_s = await departures.wait()
    await services.jog.wait_stopped()
    return 1000 * (at_s - killed_s)


async def _hold(page: Page, departures: _Departures, services: Services, number: int) -> None:
    """Hold a jog button, there and back, until the robot moves.

    On a machine that is too busy the page's sign of life may come late and end the motion; then
    the button is pressed again.
    """
    way = "On along the rail" if number % 2 == 0 else "Back along the rail"
    button = page.get_by_role("button", name=way)
    await button.hover()
    async with asyncio.timeout(PATIENCE_S):
        await expect(button).to_be_enabled(timeout=1000 * PATIENCE_S)
        while True:
            await page.mouse.down()
            while services.supervisor.plan is None:  # noqa: ASYNC110 - nothing tells of it
                await asyncio.sleep(0.01)
            departures.expect()
            await asyncio.sleep(HELD_S)
            if services.supervisor.plan is not None and not departures.left.is_set():
                return
            await page.mouse.up()
            await services.jog.wait_stopped()


async def _clock_offset(page: Page) -> float:
    """What has to be added to the page's clock to get ours [s]; the quickest of some trips."""
    best = (float("inf"), 0.0)
    for _ in range(5):
        asked_s = time.monotonic()
        there_ms: float = await page.evaluate("performance.now()")
        answered_s = time.monotonic()
        best = min(best, (answered_s - asked_s, (asked_s + answered_s) / 2 - there_ms / 1000))
    return best[1]


async def _event_s(page: Page, kind: str, offset_s: float) -> float:
    at_ms: float = await page.evaluate(
        "kind => window.handTimes.filter(([each]) => each === kind).at(-1)[1]", kind
    )
    return at_ms / 1000 + offset_s


def _browser_processes() -> list[int]:
    """Our own browser and all its children, by their parents."""
    parents: dict[int, int] = {}
    for stat in Path("/proc").glob("[0-9]*/stat"):
        with contextlib.suppress(OSError):
            fields = stat.read_text().rpartition(")")[2].split()
            parents[int(stat.parent.name)] = int(fields[1])
    ours, grown = {os.getpid()}, True
    while grown:
        more = {child for child, parent in parents.items() if parent in ours} - ours
        ours, grown = ours | more, bool(more)
    return [each for each in ours if "chrom" in _name(each)]


def _name(process: int) -> str:
    with contextlib.suppress(OSError):
        return Path(f"/proc/{process}/comm").read_text()
    return ""


def _part(values: Sequence[float], share: float) -> float:
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, round(share * (len(ordered) - 1)))]


if __name__ == "__main__":
    main()
