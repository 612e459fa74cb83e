"""Against a real server: the documented shell script, and events that survive a broken line."""

from __future__ import annotations

import json
import os
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx
import pytest

import server.api
from server.access import Scope
from tests.support.process import ServerProcess, serving

SCRIPT = Path(server.api.__file__).parent / "docs" / "plug_in.sh"


@pytest.fixture(scope="module")
def live() -> Iterator[ServerProcess]:
    with serving("--speed=20") as process:
        yield process


def run_script(live: ServerProcess) -> subprocess.CompletedProcess[str]:
    environment = {
        "PATH": os.environ["PATH"],
        "PLUGPILOT_URL": live.url,
        "PLUGPILOT_TOKEN": live.new_key(Scope.OPERATE),
        "PLUGPILOT_PAUSE_S": "0.2",
    }
    return subprocess.run(
        ["sh", str(SCRIPT)],
        env=environment,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )


def events(stream: httpx.Response) -> Iterator[dict[str, Any]]:
    """The events of a stream, each with its own id and type."""
    fields: dict[str, str] = {}
    for line in stream.iter_lines():
        if line.startswith(":"):
            continue
        if line:
            name, _, value = line.partition(": ")
            fields[name] = value
            continue
        if "data" in fields:
            data = json.loads(fields["data"])
            if fields["event"] != "gap":
                assert (data["id"], data["type"]) == (fields["id"], fields["event"])
            yield data
        fields = {}


def test_the_script_plugs_in_and_the_stream_tells_it_without_a_hole(live: ServerProcess) -> None:
    address = f"{live.url}/api/v1/events/stream"
    key = {"Authorization": f"Bearer {live.new_key(Scope.READ)}"}
    with httpx.stream("GET", address, headers=key, timeout=30) as stream:
        assert stream.headers["content-type"].startswith("text/event-stream")
        done = run_script(live)
        assert done.returncode == 0, done.stdout + done.stderr
        assert "succeeded" in done.stdout
        following = events(stream)
        first = next(event for event in following if event["type"] == "job.created")
        second = next(following)
    # The line is broken. Whoever comes back with the id of the last one misses nothing.
    with httpx.stream(
        "GET", address, headers=key | {"Last-Event-ID": second["id"]}, timeout=30
    ) as again:
        rest = []
        for event in events(again):
            rest.append(event)
            if event["type"] == "job.ended":
                break
    with live.rest() as owner:
        listed = owner.get("events", params={"cursor": first["id"]}).json()
    assert [second, *rest] == listed["items"][: len(rest) + 1]
    assert listed["complete"] is True
    assert rest[-1]["data"]["job"]["state"] == "succeeded"

    old = key | {"Last-Event-ID": "01957a3c-7d50-7c44-8e0f-5b3c9d5a1f00"}
    with httpx.stream("GET", address, headers=old, timeout=30) as stream:
        assert next(events(stream)) == {"type": "gap"}
    wrong = httpx.get(address, headers=key | {"Last-Event-ID": "nonsense"})
    assert (wrong.status_code, wrong.json()["code"]) == (400, "invalid_cursor")


def test_the_script_says_why_it_failed(live: ServerProcess) -> None:
    """The robot cannot: the problem is shown, and the status is not 0."""
    with live.rest() as owner:
        owner.post("robot/estop").raise_for_status()
    done = run_script(live)
    assert done.returncode != 0
    assert '"code":' in done.stdout
