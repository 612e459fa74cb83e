"""The 3D picture under load: ``python -m tests.bench.twin``.

Real picture, real web server and bridge in one process; the viewers run in another one, as
browsers do. Latency runs from `publish` to the arrival of the frame. To compare with: a bare
bridge that moved 20 nodes took 8, 16 and 25 % of a core for 1, 5 and 20 viewers, with 7-9 ms in
the median and 15-23 ms at p95 from setting a node, on an otherwise idle machine of two cores; a
join after a day at 30 Hz took 7.7 s of the library's loop. The goals: one viewer below 10 % of a
core, 20 viewers below 30 %, and page and first view together below 700 kB.
"""

from __future__ import annotations

import asyncio
import gc
import json
import math
import statistics
import sys
import time
from multiprocessing import get_context
from multiprocessing.connection import Connection

import httpx
import psutil

from server.api.twin.page import build_page
from tests.server.twin.conftest import _serve
from tests.support.eventually import eventually
from tests.support.twin_client import TwinClient
from twin.camera_mount import CameraMount
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import gamma
from twin.scene import TwinHost, TwinState
from twin.scene.message_buffer import ReplayBuffer

JOINS = 20
A_WEEK_OF_MESSAGES = 7 * 24 * 3600 * 30 * 20
VIEWERS = (1, 5, 20)
SECONDS = 8.0
RATE_HZ = 30.0
GEOMETRY = RobotGeometry()


def joints_at(t_s: float) -> JointPosition:
    """A robot that moves all three joints all the time."""
    return JointPosition(
        200 + 80 * math.sin(1.1 * t_s), 200 + 80 * math.cos(0.9 * t_s), 100 + 40 * math.sin(2 * t_s)
    )


def watch(address: str, viewers: int, seconds: float, result: Connection) -> None:
    """Process of the viewers: first view's bytes, and (platform x, time of arrival)."""

    async def viewer() -> tuple[int, list[tuple[float, float]]]:
        seen: list[tuple[float, float]] = []
        async with TwinClient.connected(
            f"ws://{address}/twin", origin=f"http://{address}"
        ) as client:
            await client.until_replayed()
            first = client.received_bytes
            end = time.monotonic() + seconds
            while time.monotonic() < end:
                messages = await client.receive()
                now = time.monotonic()
                seen += [
                    (m["position"][0], now)
                    for m in messages
                    if m["type"] == "SetPositionMessage" and m["name"] == "/robot/platform"
                ]
        return first, seen

    async def everyone() -> list[tuple[int, list[tuple[float, float]]]]:
        return await asyncio.gather(*(viewer() for _ in range(viewers)))

    result.send(asyncio.run(everyone()))


async def measure(host: TwinHost, address: str, viewers: int) -> dict[str, float]:
    """CPU share, latency and bytes with some viewers."""
    ours, theirs = get_context("spawn").Pipe()
    process = get_context("spawn").Process(target=watch, args=(address, viewers, SECONDS, theirs))
    process.start()
    set_at: dict[float, float] = {}
    me = psutil.Process()
    await eventually(lambda: host.watching >= viewers, within_s=60)
    await asyncio.sleep(1.0)
    cpu, started = sum(me.cpu_times()[:2]), time.monotonic()
    while time.monotonic() - started < SECONDS - 3:
        joints = joints_at(time.monotonic())
        set_at[round(gamma.platform(GEOMETRY, joints).x_mm / 1000, 9)] = time.monotonic()
        host.publish(TwinState(measured=joints, commanded=joints))
        await asyncio.sleep(1 / RATE_HZ)
    share = (sum(me.cpu_times()[:2]) - cpu) / (time.monotonic() - started)
    views = await asyncio.to_thread(ours.recv)
    process.join()
    late = [
        1000 * (at - set_at[key])
        for _, seen in views
        for x, at in seen
        if (key := round(x, 9)) in set_at
    ]
    return {
        "viewers": viewers,
        "cpu_percent": round(100 * share, 1),
        "latency_ms_median": round(statistics.median(late), 1),
        "latency_ms_p95": round(statistics.quantiles(late, n=20)[-1], 1),
        "first_view_bytes": views[0][0],
        "rss_mib": round(me.memory_info().rss / 2**20, 1),
        "poses_per_second": round(len(late) / viewers / (SECONDS - 3), 1),
    }


async def join_s(address: str) -> float:
    """From opening the connection to the end of the replay."""
    started = time.monotonic()
    async with TwinClient.connected(f"ws://{address}/twin", origin=f"http://{address}") as client:
        await client.until_replayed()
    return time.monotonic() - started


async def joins(host: TwinHost, address: str, *, after: str) -> None:
    """Prints how long browsers take to join."""
    times = sorted([await join_s(address) for _ in range(JOINS)])
    report = {"joins": after, "median_ms": round(1000 * times[JOINS // 2], 1)}
    print(json.dumps(report | {"p95_ms": round(1000 * times[-1], 1)}))
    await eventually(lambda: host.watching == 0, within_s=20)


async def a_week_later(host: TwinHost, address: str) -> None:
    """Joins beside a viewer who has watched a moving robot for a week.

    The week is skipped: it leaves nothing behind but used-up message numbers.
    """
    async with TwinClient.connected(f"ws://{address}/twin", origin=f"http://{address}") as client:
        await client.until_replayed()
        buffer = next(each for each in gc.get_objects() if isinstance(each, ReplayBuffer))
        with buffer.buffer_lock:
            buffer.message_counter += A_WEEK_OF_MESSAGES
        await client.connection.close()
    await eventually(lambda: host.watching == 0, within_s=20)
    await joins(host, address, after="a week")


async def main() -> None:
    """Prints one line of JSON for each number of viewers."""
    me = psutil.Process()
    before = me.memory_info().rss
    host = TwinHost(GEOMETRY, CameraMount(), math.radians(62.2), 4 / 3)
    started = time.monotonic()
    host.start()
    await asyncio.to_thread(host.wait_ready, 30)
    ready_s = time.monotonic() - started
    added = (me.memory_info().rss - before) / 2**20
    print(json.dumps({"ready_s": round(ready_s, 2), "rss_added_mib": round(added, 1)}))
    async with _serve(host) as address:
        async with httpx.AsyncClient() as client:  # packs the client, which is done once
            (await client.get(f"http://{address}/twin/", timeout=60)).raise_for_status()
        await asyncio.sleep(2)
        cpu = sum(me.cpu_times()[:2])
        await asyncio.sleep(3)
        idle = 100 * (sum(me.cpu_times()[:2]) - cpu) / 3
        print(json.dumps({"viewers": 0, "cpu_percent": round(idle, 1)}))
        page = build_page()
        sizes = {"page_bytes": len(page.gzipped), "client_bytes": len(page.client)}
        print(json.dumps(sizes))
        await joins(host, address, after="the start")
        for viewers in VIEWERS:
            print(json.dumps(await measure(host, address, viewers)))
            sys.stdout.flush()
            await asyncio.sleep(1)
        await a_week_later(host, address)
    await asyncio.to_thread(host.stop)
    rss = (me.memory_info().rss - before) / 2**20
    print(json.dumps({"rss_added_after_viewers_mib": round(rss, 1)}))


if __name__ == "__main__":
    asyncio.run(main())
