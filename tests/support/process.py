"""The real `plugpilot serve` in a process of its own."""

from __future__ import annotations

import asyncio
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import httpx
from playwright.sync_api import BrowserContext

from server.access import Scope
from server.access.recovery import invite_owner
from server.config.access import AccessSettings
from server.config.storage import StorageSettings

READY = "PlugPilot is ready: "
INVITATION = "Pair your browser, once: "
START_TIMEOUT_S = 180.0
ANSWER_TIMEOUT_S = 60.0
STOP_TIMEOUT_S = 60.0
"""Patience with a busy machine; what the server promises is in tests/server/test_serving.py."""


@dataclass
class ServerProcess:
    """A running server.

    Attributes:
        process: The process.
        url: Where it listens, such as http://127.0.0.1:40123.
        started_s: From its launch to the line that says so.
        data_dir: Its data folder.
    """

    process: subprocess.Popen[str]
    url: str
    started_s: float
    data_dir: Path

    @cached_property
    def cookies(self) -> dict[str, str]:
        """What the server gave to a browser that was paired as an owner's."""
        with ThreadPoolExecutor(1) as beside_any_loop:
            invitation = invite_owner(StorageSettings(data_dir=self.data_dir), AccessSettings())
            secret = beside_any_loop.submit(asyncio.run, invitation).result()
        answer = httpx.post(
            f"{self.url}/api/v1/access/pairing",
            json={"secret": secret},
            trust_env=False,
            timeout=ANSWER_TIMEOUT_S,
        )
        answer.raise_for_status()
        return dict(answer.cookies)

    @property
    def headers(self) -> dict[str, str]:
        """What a paired browser sends with every request."""
        return {"Cookie": "; ".join(f"{name}={value}" for name, value in self.cookies.items())}

    def new_key(self, *scopes: Scope) -> str:
        """A key as a program sends it."""
        with self.rest() as owner:
            made = owner.post("access/keys", json={"name": "test", "scopes": list(scopes)})
        made.raise_for_status()
        key: str = made.json()["key"]
        return key

    def rest(self, timeout_s: float = ANSWER_TIMEOUT_S) -> httpx.Client:
        """A client of the API that is paired."""
        return httpx.Client(
            base_url=f"{self.url}/api/v1/",
            headers=self.headers,
            trust_env=False,
            timeout=timeout_s,
        )

    def let_in(self, context: BrowserContext) -> None:
        """Pair a browser."""
        context.add_cookies(
            [
                {"name": name, "value": value, "url": self.url}
                for name, value in self.cookies.items()
            ]
        )

    def kill(self) -> None:
        """End it as a power cut would."""
        self.process.kill()
        self.process.wait(STOP_TIMEOUT_S)

    def stop(self) -> int:
        """Ask it to end, and return its exit status.

        Raises:
            TimeoutExpired: it hangs; where, it has written to standard error.
        """
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGTERM)
        try:
            return self.process.wait(STOP_TIMEOUT_S)
        except subprocess.TimeoutExpired:
            self.process.send_signal(signal.SIGABRT)
            self.process.wait()
            raise


@contextmanager
def serving(*options: str, data_dir: Path | None = None) -> Iterator[ServerProcess]:
    """Run `plugpilot serve` on a free port until the block ends."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = data_dir or Path(scratch) / "data"
        server = start(*options, data_dir=folder, cwd=Path(scratch))
        try:
            yield server
        finally:
            if server.process.poll() is None:
                server.stop()
            if server.process.stdout is not None:
                server.process.stdout.close()


def start(*options: str, data_dir: Path, cwd: Path) -> ServerProcess:
    """Start the server and wait for its line; the caller ends it."""
    command = [
        sys.executable,
        "-c",
        "from server.cli import main; main()",
        "serve",
        "--port=0",
        f"--data-dir={data_dir}",
        *options,
    ]
    environment = {k: v for k, v in os.environ.items() if not k.startswith("PLUGPILOT_")}
    environment["PYTHONPATH"] = str(Path(__file__).parents[2])
    environment["PYTHONFAULTHANDLER"] = "1"
    launched_s = time.perf_counter()
    process = subprocess.Popen(
        command, cwd=cwd, env=environment, stdout=subprocess.PIPE, text=True, bufsize=1
    )
    overdue = threading.Timer(START_TIMEOUT_S, process.kill)
    overdue.start()
    try:
        assert process.stdout is not None
        line = process.stdout.readline()
    finally:
        overdue.cancel()
    if not line.startswith(READY):
        process.kill()
        process.wait()
        process.stdout.close()
        raise AssertionError(f"the server did not start; it printed {line!r}")
    return ServerProcess(
        process, line.removeprefix(READY).strip(), time.perf_counter() - launched_s, data_dir
    )
