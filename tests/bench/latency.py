"""How quick the API is while the robot works: `python -m tests.bench.latency`.

Fifty watchers hold the WebSocket and one script reads the state, each from a process of its own,
while jobs run on the simulator in real time. Measured are a read of the state, the age of the
telemetry that a watcher gets (so the time from the sample to the watcher, with everything between),
and how evenly the control loop gets its turn in the same process. The clients stand for other
machines, so they yield this one's processors to the server. Options: seconds, watchers.
"""

from __future__ import annotations

import asyncio
import contextlib
import http.client
import json
import re
import statistics
import sys
import tempfile
import time
from collections.abc import Sequence
from datetime import UTC, datetime
from http import HTTPStatus
from pathlib import Path
from urllib.parse import urlsplit

from websockets.asyncio.client import ClientConnection, connect

from drivers.robot import BoardState
from drivers.simulator.parameters import BoardParameters, SimulationParameters
from server.access import Scope
from server.api.app import create_app
from server.composition import running
from server.config.settings import Settings
from server.config.simulation import SimulationSettings
from server.jobs.model import JobType
from server.schema.jobs import JobRequest
from server.services import Services
from server.serving import THREADS_TURN_S
from server.simulation import park_first
from server.tidying import tidying_at_rest
from tests.support.fake_stations.serving import serving
from tests.support.pairing import new_key

SECONDS, WATCHERS = 20.0, 50
TELEMETRY_S, TICK_S = 0.01, 0.02
READ_PAUSE_S = 0.01
SETTLING_S = 0.5
YIELDING = ("nice", "-n", "10")
TARGETS_MS = {"read of the state": 10.0, "push to a watcher": 50.0, "control loop": 5.0}

STEADY_BOARD = SimulationSettings(
    parameters=SimulationParameters(board=BoardParameters(telemetry_jitter_s=0))
)
"""The simulated cable's own jitter of 2 ms would be counted as the loop's."""

MOVING = re.compile(r'"robot":{"mode":"moving".*?"updated_at":"([^"]+)"}')

Times = dict[str, list[float]]


def main() -> None:
    """Measure and print; with an address, be a client."""
    if len(sys.argv) > 1 and sys.argv[1].startswith("http"):
        url, given_s, count = sys.argv[1], float(sys.argv[2]), int(sys.argv[3])
        key = {"Authorization": f"Bearer {sys.argv[4]}"}
        if count:
            print(json.dumps(asyncio.run(_watch_all(url, key, given_s, count))))
        else:
            print(json.dumps(_read(url, key, given_s)))
        return
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else SECONDS
    watchers = int(sys.argv[2]) if len(sys.argv) > 2 else WATCHERS
    sys.setswitchinterval(THREADS_TURN_S)
    with tempfile.TemporaryDirectory() as folder:
        measured = asyncio.run(_measure(Path(folder), seconds, watchers))
    head = f"{watchers} watchers, {seconds:.0f} s, jobs running"
    print(f"{head:<40}median    p95    p99     max  target")
    for name, values in measured.items():
        target = next((ms for key, ms in TARGETS_MS.items() if name.startswith(key)), None)
        print(
            f"{name:<38}{statistics.median(values):>8.2f}{_part(values, 0.95):>7.2f}"
            f"{_part(values, 0.99):>7.2f}{max(values):>8.2f}"
            + (f"  p99 < {target:g} ms" if target else "")
            + f"  ({len(values)} values)"
        )


async def _measure(folder: Path, seconds: float, watchers: int) -> Times:
    async with running(Settings(simulation=STEADY_BOARD), folder=folder) as services:
        await park_first(services)
        app = create_app(lambda: contextlib.nullcontext(services))
        app.state.services = services
        async with serving(app) as url, tidying_at_rest(lambda: False):
            began_s, began_cpu_s = time.perf_counter(), time.process_time()
            loop_times = _listen(services)
            helpers = [asyncio.create_task(_tick(loop_times)), asyncio.create_task(_work(services))]
            key = await new_key(services.access, Scope.READ)
            pushes_ms, reads_ms = await asyncio.gather(
                _client(url, key, seconds, watchers), _client(url, key, seconds, 0)
            )
            for helper in helpers:
                helper.cancel()
            await asyncio.gather(*helpers, return_exceptions=True)
            spent_s = time.process_time() - began_cpu_s
            share = spent_s / (time.perf_counter() - began_s)
            print(f"the server needs {100 * share:.0f} % of a core")
            return {
                "read of the state, GET /robot": reads_ms,
                "push to a watcher, age of telemetry": pushes_ms,
            } | loop_times


async def _client(url: str, key: str, seconds: float, watchers: int) -> list[float]:
    client = await asyncio.create_subprocess_exec(
        *(
            *YIELDING,
            sys.executable,
            "-m",
            "tests.bench.latency",
            url,
            str(seconds),
            str(watchers),
            key,
        ),
        stdout=asyncio.subprocess.PIPE,
    )
    output, _ = await client.communicate()
    values: list[float] = json.loads(output)
    return values


def _listen(services: Services) -> Times:
    """Note how far apart samples are taken up while the robot moves, against their period."""
    times: Times = {"control loop, period of telemetry": [], "control loop, period of 20 ms": []}
    seen: list[object] = [None]
    last_s: list[float | None] = [None]

    def telemetry() -> None:
        state = services.supervisor.telemetry.latest
        if state is None or state is seen[0]:
            return
        seen[0] = state
        now_s = time.perf_counter()
        moving = state.board is BoardState.RUN
        if moving and last_s[0] is not None:
            deviation_ms = 1000 * abs(now_s - last_s[0] - TELEMETRY_S)
            times["control loop, period of telemetry"].append(deviation_ms)
        last_s[0] = now_s if moving else None

    services.supervisor.listen(telemetry)
    return times


async def _tick(times: Times) -> None:
    loop = asyncio.get_running_loop()
    due_s = loop.time()
    while True:
        due_s = max(due_s + TICK_S, loop.time())
        await asyncio.sleep(due_s - loop.time())
        times["control loop, period of 20 ms"].append(1000 * abs(loop.time() - due_s))


async def _work(services: Services) -> None:
    """One job after the other."""
    while True:
        for job_type in (JobType.PLUG_IN, JobType.UNPLUG):
            await services.runner.create(JobRequest(type=job_type), key=None, digest=None)
            await services.runner.wait()


def _read(url: str, key: dict[str, str], seconds: float) -> list[float]:
    times_ms: list[float] = []
    parts = urlsplit(url)
    connection = http.client.HTTPConnection(str(parts.hostname), parts.port)
    until_s = time.perf_counter() + seconds
    while time.perf_counter() < until_s:
        asked_s = time.perf_counter()
        connection.request("GET", "/api/v1/robot", headers=key)
        answer = connection.getresponse()
        answer.read()
        if answer.status != HTTPStatus.OK:
            raise SystemExit(f"GET /robot: {answer.status} {answer.reason}")
        times_ms.append(1000 * (time.perf_counter() - asked_s))
        time.sleep(READ_PAUSE_S)
    connection.close()
    return times_ms


async def _watch_all(url: str, key: dict[str, str], seconds: float, watchers: int) -> list[float]:
    ages_ms: list[float] = []
    address = url.replace("http", "ws", 1) + "/api/v1/ws"
    sockets: list[ClientConnection] = []
    watching: list[asyncio.Task[None]] = []
    for _ in range(watchers):
        sockets.append(await connect(address, additional_headers=key, proxy=None))
        watching.append(asyncio.create_task(_watch(sockets[-1], ages_ms)))
    # What came while not all of them were there was kept waiting here, not by the server.
    await asyncio.sleep(SETTLING_S)
    ages_ms.clear()
    await asyncio.sleep(seconds)
    for task in watching:
        task.cancel()
    await asyncio.gather(*watching, return_exceptions=True)
    for socket in sockets:
        await socket.close()
    return ages_ms


async def _watch(socket: ClientConnection, ages_ms: list[float]) -> None:
    """Take the age of each sample once; right after a standstill samples are still rare."""
    before: str | None = None
    async for message in socket:
        arrived = datetime.now(UTC)
        text = str(message)
        if '"robot":' not in text:
            continue
        # Reading all of it would take the one process of all watchers longer than sending it.
        robot = MOVING.search(text)
        sampled = None if robot is None else robot.group(1)
        if sampled is not None and before is not None and sampled != before:
            age = arrived - datetime.fromisoformat(sampled)
            ages_ms.append(1000 * age.total_seconds())
        before = sampled


def _part(values: Sequence[float], share: float) -> float:
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, round(share * (len(ordered) - 1)))]


if __name__ == "__main__":
    main()
