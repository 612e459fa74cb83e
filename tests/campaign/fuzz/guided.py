"""Fuzzes the readers of foreign bytes, led by coverage: ``python -m tests.campaign.fuzz.guided``.

Atheris notes which lines an input reached and goes on from the inputs that reached new ones. It
runs until it finds something or its time is over, one process for each target. It has wheels for
Linux on x86-64 only, so it is installed by ``make fuzz-guided`` and by nothing else.
"""

from __future__ import annotations

import argparse
import contextlib
import importlib
import re
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Required

from pydantic import TypeAdapter
from typing_extensions import TypedDict

TestOne = Callable[[bytes], None]
EXECUTED = re.compile(r"stat::number_of_executed_units:\s+(\d+)")
MOST_BYTES = 512
SHOWN = 3000
"""Characters of what went wrong."""


def _frames() -> TestOne:
    """Bytes at the serial line, raw and as the content of frames that are right in their form."""
    frames = importlib.import_module("drivers.arduino.link.frames")
    messages = importlib.import_module("drivers.arduino.protocol.messages")
    telemetry = importlib.import_module("drivers.arduino.telemetry")
    scale = importlib.import_module("drivers.arduino.scale")
    settings = importlib.import_module("drivers.arduino.settings").BoardSettings()
    scales = [scale.AxisScale(axis.units_per_mm) for axis in settings.axes]
    kinds = [messages.MESSAGES[number] for number in sorted(messages.FROM_BOARD)]

    def one(data: bytes) -> None:
        reader = frames.FrameReader(messages.FROM_BOARD)
        whole = [*reader.feed(data[: len(data) // 2]), *reader.feed(data[len(data) // 2 :])]
        if len(data) > 3:
            kind = kinds[data[0] % len(kinds)]
            content = data[3:].ljust(kind.LAYOUT.size, b"\0")[: kind.LAYOUT.size]
            said = frames.Frame(data[1], data[2], kind.unpack(content))
            (heard,) = frames.FrameReader(messages.FROM_BOARD).feed(frames.encode_frame(said))
            if frames.encode_frame(heard) != frames.encode_frame(said):
                raise AssertionError(f"{said} was heard as {heard}")
            whole.append(heard)
        for frame in whole:
            if isinstance(frame.message, messages.Telemetry):
                with contextlib.suppress(ValueError):  # a state or fault that nobody knows
                    telemetry.robot_state(
                        frame.message, None, scales,
                        sampled_at_s=0.0, received_at_s=0.0, queue_capacity=32,
                    )  # fmt: skip

    return one


def _labels() -> TestOne:
    """Texts in labels."""
    payload = importlib.import_module("server.labels.payload")
    recognise = importlib.import_module("server.labels.recognise")
    key = payload.LabelKey(bytes(range(16)))
    wanted = payload.label_text("zoe", key)

    def one(data: bytes) -> None:
        text = data.decode("utf-8", errors="replace")
        label = payload.parse_label_text(text)
        recognise.why_not_the_label([text], wanted)
        if label is not None and label.intact:
            ours = payload.label_text(label.vehicle, key)
            if len(text) != len(ours) or not text.startswith(f"PP{label.version}:{label.vehicle}:"):
                raise AssertionError(f"{text!r} passes for an intact label of {label.vehicle!r}")

    return one


def _gate() -> TestOne:
    """The heads of a request that decide whether a stranger's page made it, and its cursor."""
    origin = importlib.import_module("server.api.gate.origin")
    pagination = importlib.import_module("server.api.pagination")
    errors = importlib.import_module("server.errors")

    def one(data: bytes) -> None:
        text = data.decode("latin-1")
        host, _, page = text.partition("\n")
        if origin.is_own_host(host, ()) and origin.host_name(host).endswith(".example"):
            raise AssertionError(f"{host!r} passes for this machine")
        if origin.is_own_origin(page, "http", "robot.local") and "robot.local" not in page.lower():
            raise AssertionError(f"{page!r} passes for a page of robot.local")
        heads = {"host": host, "origin": page, "sec-fetch-site": page}
        origin.is_from_elsewhere(heads, "http", opens_page=False)
        for read in (pagination.id_in, pagination.number_in):
            with contextlib.suppress(errors.PlugPilotError):
                read(host)

    return one


class _Sample(TypedDict, total=False):
    """What the schema of OCPP lets through."""

    value: Required[str]
    unit: str
    measurand: str
    phase: str
    format: str


def _meter() -> TestOne:
    """What a charging station says it measured."""
    meter = importlib.import_module("drivers.station.ocpp16.meter")
    values = TypeAdapter[list[_Sample]](list[_Sample])

    def one(data: bytes) -> None:
        with contextlib.suppress(ValueError):  # its own error, and that of the schema
            meter.read_meter(values.validate_json(data))

    return one


TARGETS: dict[str, tuple[Callable[[], TestOne], tuple[str, ...], tuple[bytes, ...]]] = {
    "frames": (_frames, ("drivers.arduino",), (bytes(40), b"\x03\x81\x01\x01\0")),
    "labels": (_labels, ("server.labels",), (b"PLUGPILOT:1:zoe", b"PP3:zoe:AAAAAAAAAA")),
    "gate": (_gate, ("server.api", "urllib"), (b"robot.local:80\nhttp://robot.local", b"[::1]\n")),
    "meter": (_meter, ("drivers.station.ocpp16.meter",), (b'[{"value":"1","unit":"Wh"}]',)),
}
"""How each is built, which packages are watched, and what it begins with."""


def main() -> int:
    """Returns the exit code."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("target", nargs="?", choices=sorted(TARGETS), help="all, when left out")
    parser.add_argument("--minutes", type=float, default=10.0, help="for each target")
    options = parser.parse_args()
    if options.target is not None:
        _fuzz(options.target, round(60 * options.minutes))
        return 0
    broken = 0
    for name in TARGETS:
        command = (sys.executable, "-m", __spec__.name, name, "--minutes", str(options.minutes))
        run = subprocess.run(command, capture_output=True, text=True, check=False)
        executed = EXECUTED.search(run.stderr)
        print(f"{name:<10}{executed.group(1) if executed else '?':>12} inputs", flush=True)
        if run.returncode != 0:
            broken += 1
            print(f"BROKEN: {name}\n{run.stdout[-SHOWN:]}\n{run.stderr[-SHOWN:]}")
    return 1 if broken else 0


def _fuzz(name: str, seconds: int) -> None:
    """Does not return: Atheris ends the process."""
    atheris = importlib.import_module("atheris")
    build, watched, seeds = TARGETS[name]
    with atheris.instrument_imports(include=list(watched)):
        one = build()
    with tempfile.TemporaryDirectory() as corpus:
        for number, seed in enumerate(seeds):
            (Path(corpus) / str(number)).write_bytes(seed)
        limits = (f"-max_total_time={seconds}", f"-max_len={MOST_BYTES}", "-print_final_stats=1")
        atheris.Setup([sys.argv[0], *limits, f"-artifact_prefix={corpus}/", corpus], one)
        atheris.Fuzz()


if __name__ == "__main__":
    sys.exit(main())
