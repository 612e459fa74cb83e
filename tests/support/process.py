"""The real `plugpilot serve` in a process of its own."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

READY = "PlugPilot is ready: "
START_TIMEOUT_S = 60.0
STOP_TIMEOUT_S = 10.0


@dataclass
class ServerProcess:
    """A running server.

    Attributes:
        process: The process.
        url: Where it listens, such as http://127.0.0.1:40123.
        started_s: From its launch to the line that says so.
    """

    process: subprocess.Popen[str]
    url: str
    started_s: float

    def kill(self) -> None:
        """End it as a power cut would."""
        self.process.kill()
        self.process.wait(STOP_TIMEOUT_S)

    def stop(self) -> int:
        """Ask it to end, and return its exit status."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGTERM)
        return self.process.wait(STOP_TIMEOUT_S)


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
        raise AssertionError(f"the server did not start; it printed {line!r}")
    return ServerProcess(
        process, line.removeprefix(READY).strip(), time.perf_counter() - launched_s
    )
