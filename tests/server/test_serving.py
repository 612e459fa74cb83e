"""The real program: how it starts, how it refuses to, and how it ends."""

from __future__ import annotations

import asyncio
import json
import os
import signal
import socket
import sqlite3
import subprocess
import sys
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import httpx
import pytest
from websockets.sync.client import connect

from tests.support.eventually import eventually
from tests.support.process import READY, ServerProcess, serving, start

ENDS_WITHIN_S = 3.0
PROJECT = Path(__file__).parents[2]


def _run(*arguments: str, cwd: Path) -> subprocess.CompletedProcess[str]:
    """Run the command to its end."""
    environment = {k: v for k, v in os.environ.items() if not k.startswith("PLUGPILOT_")}
    return subprocess.run(
        [sys.executable, "-c", "from server.cli import main; main()", *arguments],
        cwd=cwd,
        env={**environment, "PYTHONPATH": str(PROJECT)},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )


def _assert_told_in_words(run: subprocess.CompletedProcess[str], *words: str) -> None:
    assert run.returncode == 2
    assert run.stdout == ""
    assert "Traceback" not in run.stderr
    assert len(run.stderr.strip().splitlines()) <= 3
    for word in words:
        assert word in run.stderr


def _rest(server: ServerProcess) -> httpx.Client:
    return server.rest()


def _until(condition: Callable[[], bool]) -> None:
    deadline_s = time.monotonic() + 30.0
    while not condition():
        assert time.monotonic() < deadline_s


def _robot(client: httpx.Client) -> dict[str, Any]:
    state: dict[str, Any] = client.get("robot").json()
    return state


def _plug_in(client: httpx.Client) -> str:
    """Begin a job as soon as the motion board is there; gives its id."""
    _until(lambda: _robot(client)["mode"] != "offline")
    answer = client.post("jobs", json={"type": "plug_in"})
    assert answer.status_code == 202, answer.text
    return str(answer.json()["id"])


def test_it_says_where_it_is_once_and_ends_soon_with_everybody_watching(tmp_path: Path) -> None:
    server = start(data_dir=tmp_path / "data", cwd=tmp_path)
    stdout = server.process.stdout
    assert stdout is not None
    with (
        stdout,
        _rest(server) as client,
        client.stream("GET", "camera/stream.mjpg") as stream,
        connect(
            server.url.replace("http", "ws") + "/api/v1/ws",
            additional_headers=server.headers,
            proxy=None,
        ) as watcher,
    ):
        next(stream.iter_bytes())
        watcher.recv()
        with _rest(server) as other:
            _plug_in(other)
            _until(lambda: _robot(other)["mode"] == "homing")
        asked_s = time.monotonic()
        server.process.send_signal(signal.SIGTERM)
        status = server.process.wait(20)
        assert time.monotonic() - asked_s < ENDS_WITHIN_S
        assert status == 0
        (invitation,) = stdout.read().splitlines()
        assert invitation.startswith(f"Pair your browser, once: {server.url}/#pair=")
    # everything is on disk, and nothing was left for SQLite to repair
    assert not (tmp_path / "data" / "plugpilot.sqlite3-wal").exists()
    with sqlite3.connect(tmp_path / "data" / "plugpilot.sqlite3") as database:
        assert database.execute("PRAGMA integrity_check").fetchone() == ("ok",)
        assert database.execute("SELECT type FROM jobs").fetchall() == [("plug_in",)]
    database.close()


def test_a_killed_job_goes_on_after_the_restart(tmp_path: Path) -> None:
    with serving("--speed=20", data_dir=tmp_path) as server, _rest(server) as client:
        job_id = _plug_in(client)
        # moving in means that the plug's new place is on disk already
        going_in = {"plug": "inserted", "mode": "moving"}
        _until(lambda: going_in.items() <= _robot(client).items())
        server.kill()
    with serving("--speed=20", data_dir=tmp_path) as server, _rest(server) as client:
        _until(lambda: client.get(f"jobs/{job_id}").json()["state"] == "succeeded")
        assert client.get("robot").json()["plug"] == "inserted"
        events = client.get(f"jobs/{job_id}/events").json()["items"]
        assert [event["sequence"] for event in events] == list(range(1, len(events) + 1))
        assert "resumed" in {event["kind"] for event in events}


async def _is_connected(client: httpx.AsyncClient) -> bool:
    return bool((await client.get("robot")).json()["mode"] != "offline")


async def test_requests_that_come_at_the_same_time_give_one_job() -> None:
    with serving() as server:
        async with httpx.AsyncClient(
            base_url=f"{server.url}/api/v1/",
            headers=server.headers,
            trust_env=False,
            timeout=20.0,
        ) as client:
            await eventually(partial(_is_connected, client))
            key = {"Idempotency-Key": "twice"}
            answers = await asyncio.gather(
                *(client.post("jobs", json={"type": "plug_in"}, headers=key) for _ in range(10))
            )
            assert {answer.status_code for answer in answers} == {202}
            assert len({answer.json()["id"] for answer in answers}) == 1
            others = await asyncio.gather(
                *(client.post("jobs", json={"type": "plug_in"}) for _ in range(5))
            )
            assert sorted(answer.status_code for answer in others) == [202, 409, 409, 409, 409]
            refused = [answer.json() for answer in others if answer.status_code == 409]
            assert {answer["code"] for answer in refused} == {"job_queue_full"}
            assert len((await client.get("jobs")).json()["items"]) == 2


def test_an_error_inside_is_a_problem_on_a_real_socket_too(tmp_path: Path) -> None:
    with serving(data_dir=tmp_path) as server, _rest(server) as client:
        with sqlite3.connect(tmp_path / "plugpilot.sqlite3") as database:
            # what only a bug, or a hand in the file, can bring about
            database.execute("""UPDATE vehicles SET settings = '{"wings": 2}'""")
        database.close()
        answer = client.get("vehicles")
        assert answer.status_code == 500
        assert answer.headers["content-type"] == "application/problem+json"
        assert answer.json()["code"] == "internal"
        assert client.get("health").status_code == 200


def test_a_port_in_use_is_told_in_a_sentence(tmp_path: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as other:
        port = str(other.getsockname()[1])
        run = _run("serve", "--port", port, "--data-dir", "data", cwd=tmp_path)
    _assert_told_in_words(run, f"Another program listens on 127.0.0.1 port {port}.", "--port")
    assert not (tmp_path / "data").exists()


@pytest.mark.parametrize("host", ["192.0.2.1", "no.such.host.invalid"])
def test_an_address_that_is_not_ours_is_told_in_a_sentence(host: str, tmp_path: Path) -> None:
    _assert_told_in_words(_run("serve", "--host", host, "--port", "0", cwd=tmp_path), host)


def test_a_configuration_that_cannot_be_read_is_told_in_a_sentence(tmp_path: Path) -> None:
    _assert_told_in_words(_run("serve", "--config", "missing.toml", cwd=tmp_path), "missing.toml")
    broken = tmp_path / "broken.toml"
    broken.write_text("[server\nport = 1")
    _assert_told_in_words(_run("serve", "--config", "broken.toml", cwd=tmp_path), "broken.toml")


def test_a_damaged_database_is_told_and_left_alone_and_the_robot_starts(tmp_path: Path) -> None:
    damaged = tmp_path / "plugpilot.sqlite3"
    damaged.write_text(json.dumps({"this is": "no database"}) * 100)
    before = damaged.read_bytes()
    with (
        serving(data_dir=tmp_path) as server,
        httpx.Client(base_url=f"{server.url}/api/v1/", trust_env=False, timeout=20.0) as client,
    ):
        health = client.get("health").json()
        assert health["status"] == "degraded"
        assert health["components"]["storage"]["status"] == "down"
        assert "plugpilot restore" in health["components"]["storage"]["detail"]
        assert client.post("robot/stop").status_code < 300
        # Nobody is known, so the terminal lets somebody in; the plug may have to come out.
        assert server.process.stdout is not None
        secret = server.process.stdout.readline().strip().partition("#pair=")[2]
        assert client.get("robot").status_code == 401
        assert client.post("access/pairing", json={"secret": secret}).status_code == 200
        assert client.post("robot/reset").status_code == 200
    assert damaged.read_bytes() == before


def test_a_second_server_does_not_take_the_same_folder(tmp_path: Path) -> None:
    with serving(data_dir=tmp_path):
        run = _run("serve", "--port", "0", "--data-dir", str(tmp_path), cwd=tmp_path)
        _assert_told_in_words(run, "Another PlugPilot uses", "--data-dir")


def test_a_driver_that_is_not_there_yet_is_told_in_a_sentence(tmp_path: Path) -> None:
    run = _run("serve", "--port", "0", "--driver", "teleporter", cwd=tmp_path)
    _assert_told_in_words(run, "teleporter")


def test_the_start_line_and_the_invitation_are_all_there_is() -> None:
    with serving() as server:
        assert server.url.startswith("http://127.0.0.1:")
        assert READY not in server.url
        status = server.stop()
        assert status == 0
        assert server.process.stdout is not None
        (invitation,) = server.process.stdout.read().splitlines()
        assert invitation.startswith(f"Pair your browser, once: {server.url}/#pair=")
