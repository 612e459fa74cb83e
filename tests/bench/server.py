"""How quick and how small the server is: `python -m tests.bench.server`.

Start to usable, resident memory, idle CPU, and the time from a command to the pushed state that
shows it, with 1, 10 and 50 watchers. The anchors are what other machine dashboards need on a
machine of this size (2 cores), measured the same way.
"""

from __future__ import annotations

import asyncio
import json
import os
import statistics
import time
from collections.abc import Sequence
from pathlib import Path

import httpx
from websockets.asyncio.client import ClientConnection, connect

from tests.support.process import ServerProcess, serving

STARTS = 5
IDLE_S = 10.0
COMMANDS = 40
WATCHERS = (1, 10, 50)

ANCHORS = """\
For comparison              usable   memory         idle CPU   command to push, 1 / 50 clients
  OctoPrint 1.11.8          3.6 s    132 MiB        1.5 %      176/476   127/399 ms (median/p95)
  Moonraker                 1.2 s    58 MiB         0.3 %      137/252   126/235 ms
  Reachy Mini daemon        3.55 s   130 MiB        3.3 %      41/73     56/66 ms
  bare FastAPI              0.5 s    50-90 MiB      0.9 %      2.9/4.0   9.3/9.8 ms
Aims                        1.5 s    150 MiB        2 %        p95 20 ms with 10 clients"""


def main() -> None:
    """Measure and print."""
    starts_s = [_start_to_usable() for _ in range(STARTS)]
    print(
        f"start to usable       median {statistics.median(starts_s):.2f} s, "
        f"worst {max(starts_s):.2f} s of {STARTS}"
    )
    with serving() as server:
        _wait_for_twin(server)
        print(f"memory, twin loaded   {_resident_mib(server):.0f} MiB")
        print(f"idle CPU              {_cpu_percent(server, IDLE_S):.1f} % of one core")
        asyncio.run(_measure_pushes(server))
        with server.rest() as client:
            client.get("camera/snapshot.jpg").raise_for_status()
        print(f"memory, after a picture of the simulated camera   {_resident_mib(server):.0f} MiB")
    print(f"\n{ANCHORS}")


def _start_to_usable() -> float:
    """From launching the process to the first answer of its API [s]."""
    launched_s = time.perf_counter()
    with serving() as server:
        httpx.get(f"{server.url}/api/v1/health").raise_for_status()
        return time.perf_counter() - launched_s


def _wait_for_twin(server: ServerProcess) -> None:
    """Wait for the 3D picture and load its page once, as a browser does."""
    httpx.get(f"{server.url}/twin/", headers=server.headers, timeout=30).raise_for_status()


async def _measure_pushes(server: ServerProcess) -> None:
    for watchers in WATCHERS:
        times_ms = await _command_to_push(server, watchers)
        print(
            f"command to push       {watchers:>2} watchers: "
            f"median {statistics.median(times_ms):.1f} ms, p95 {_p95(times_ms):.1f} ms "
            f"of {len(times_ms)}"
        )


async def _command_to_push(server: ServerProcess, watchers: int) -> list[float]:
    """From sending stop or reset until every watcher has the new mode [ms]."""
    address = server.url.replace("http", "ws", 1) + "/api/v1/ws"
    sockets = [
        await connect(address, additional_headers=server.headers, proxy=None)
        for _ in range(watchers)
    ]
    times_ms = []
    try:
        for socket in sockets:
            await socket.recv()
        async with httpx.AsyncClient(
            base_url=f"{server.url}/api/v1", headers=server.headers
        ) as client:
            for number in range(COMMANDS):
                command, modes = ("stop", {"stopped"}) if number % 2 == 0 else ("reset", {"off"})
                sent_s = time.perf_counter()
                seen = [asyncio.create_task(_mode_seen(socket, modes)) for socket in sockets]
                (await client.post(f"/robot/{command}")).raise_for_status()
                times_ms.append(1000 * (max(await asyncio.gather(*seen)) - sent_s))
    finally:
        for socket in sockets:
            await socket.close()
    return times_ms


async def _mode_seen(socket: ClientConnection, modes: set[str]) -> float:
    while True:
        message = json.loads(await socket.recv())
        robot = message.get("changes", {}).get("robot")
        if robot is not None and robot["mode"] in modes:
            return time.perf_counter()


def _resident_mib(server: ServerProcess) -> float:
    pages = int(Path(f"/proc/{server.process.pid}/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 2**20


def _cpu_percent(server: ServerProcess, seconds: float) -> float:
    before_s = _cpu_s(server)
    time.sleep(seconds)
    return 100 * (_cpu_s(server) - before_s) / seconds


def _cpu_s(server: ServerProcess) -> float:
    fields = Path(f"/proc/{server.process.pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def _p95(values: Sequence[float]) -> float:
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, round(0.95 * (len(ordered) - 1)))]


if __name__ == "__main__":
    main()
