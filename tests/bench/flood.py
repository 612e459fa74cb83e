"""A resident's stop while strangers do their worst: `python -m tests.bench.flood`.

1000 connections send nothing, or a byte now and then, and more of them flood the way in; a paired
phone sends stops over its WebSocket, and another one over new connections. The time is from the
press to the confirmation that the motion board was told. The flood runs in a process of its own, on
the same machine as the server: with two cores it takes one of them away.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import resource
import ssl
import statistics
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from urllib.parse import urlsplit

import httpx
from websockets.asyncio.client import connect

from tests.support.process import ServerProcess, serving

SLOW_CONNECTIONS = 1000
FLOODERS = 50
STOPS = 60
PAUSE_S = 0.1
AIM_MS = 100.0
SLOW_STARTS = (
    b"",
    b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nX-Slow: ",
    b"POST /api/v1/access/pairing HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 60000\r\n\r\n",
)


def main() -> None:
    """Measure and print."""
    if len(sys.argv) == 3:
        asyncio.run(_attack(sys.argv[1], sys.argv[2]))
        return
    print(f"A stop of a paired phone, press to confirmation, {STOPS} of each; the aim is")
    print(f"{AIM_MS:.0f} ms.{'':25}WebSocket                new connection")
    with serving() as server:
        resident = _resident(server)
        _print("nobody else", server, resident)
        for kind, title in (
            ("slow", f"{SLOW_CONNECTIONS} slow or silent"),
            ("login", f"{FLOODERS} flood the way in"),
            ("both", "both at the same time"),
        ):
            with _attacked(server, kind):
                _print(title, server, resident)


@contextlib.contextmanager
def _attacked(server: ServerProcess, kind: str) -> Iterator[None]:
    attack = subprocess.Popen(
        [sys.executable, "-m", "tests.bench.flood", kind, server.url],
        stdout=subprocess.PIPE,
        text=True,
    )
    try:
        assert attack.stdout is not None
        assert attack.stdout.readline().startswith("attacking")
        yield
    finally:
        attack.terminate()
        report, _ = attack.communicate()
        print(report.strip())


def _resident(server: ServerProcess) -> dict[str, str]:
    """What the browser of somebody of the family sends along."""
    with server.rest() as owner:
        made = owner.post("access/invitations", json={"name": "Ben", "role": "resident"})
        made.raise_for_status()
    secret = made.json()["address"].partition("#pair=")[2]
    with httpx.Client(base_url=server.url, trust_env=False) as phone:
        phone.post("/api/v1/access/pairing", json={"secret": secret}).raise_for_status()
        return {"Cookie": "; ".join(f"{name}={value}" for name, value in phone.cookies.items())}


def _print(title: str, server: ServerProcess, resident: dict[str, str]) -> None:
    over_socket, over_new = asyncio.run(_stops(server, resident))
    print(f"  {title:<26}{_figures(over_socket)}   {_figures(over_new)}", flush=True)


def _figures(times_ms: Sequence[float]) -> str:
    ordered = sorted(times_ms)
    p95 = ordered[round(0.95 * (len(ordered) - 1))]
    return f"{statistics.median(ordered):5.1f} / {p95:5.1f} / {ordered[-1]:5.1f} ms"


async def _stops(server: ServerProcess, headers: dict[str, str]) -> tuple[list[float], list[float]]:
    over_socket, over_new = [], []
    address = server.url.replace("http", "ws", 1) + "/api/v1/ws"
    async with connect(address, additional_headers=headers, proxy=None) as socket:
        for number in range(STOPS):
            began_s = time.perf_counter()
            await socket.send(json.dumps({"type": "stop", "id": number}))
            while json.loads(await socket.recv()).get("id") != number:
                pass
            over_socket.append(1000 * (time.perf_counter() - began_s))
            await asyncio.sleep(PAUSE_S)
            async with httpx.AsyncClient(headers=headers, trust_env=False) as phone:
                began_s = time.perf_counter()
                answer = await phone.post(f"{server.url}/api/v1/robot/stop", timeout=20)
                answer.raise_for_status()
                over_new.append(1000 * (time.perf_counter() - began_s))
            await asyncio.sleep(PAUSE_S)
    return over_socket, over_new


async def _attack(kind: str, url: str) -> None:
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (max(soft, min(hard, 8192)), hard))
    parts = urlsplit(url)
    host, port = str(parts.hostname), int(parts.port or 80)
    attackers = []
    if kind in {"slow", "both"}:
        attackers += [_slow(host, port, number) for number in range(SLOW_CONNECTIONS)]
    if kind in {"login", "both"}:
        attackers += [_login(url) for _ in range(FLOODERS)]
    tasks = [asyncio.create_task(attacker) for attacker in attackers]
    await asyncio.sleep(3)
    print("attacking", flush=True)
    await asyncio.gather(*tasks)


async def _slow(host: str, port: int, number: int) -> None:
    """Sends nothing, or one byte a second; comes back when it is thrown out."""
    await asyncio.sleep(2 * number / SLOW_CONNECTIONS)
    while True:
        with contextlib.suppress(OSError):
            reader, writer = await asyncio.open_connection(host, port)
            writer.write(SLOW_STARTS[number % len(SLOW_STARTS)])
            while not reader.at_eof() and not writer.is_closing():
                await asyncio.sleep(1)
                if number % len(SLOW_STARTS):
                    writer.write(b"x")
                    await writer.drain()
            writer.close()
        await asyncio.sleep(1)


async def _login(url: str) -> None:
    """Guesses invitations as fast as it is answered."""
    unverified = ssl.create_default_context()
    async with httpx.AsyncClient(trust_env=False, verify=unverified, timeout=30) as client:
        while True:
            with contextlib.suppress(httpx.HTTPError):
                await client.post(
                    f"{url}/api/v1/access/pairing", json={"secret": "guessed-but-wrong-again"}
                )


if __name__ == "__main__":
    main()
