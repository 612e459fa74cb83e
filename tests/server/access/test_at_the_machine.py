"""What whoever holds the machine in hand can do from its command line while the server runs."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest
from click.testing import CliRunner, Result

from server.cli import main
from tests.support.process import INVITATION, ServerProcess, serving

pytestmark = pytest.mark.usefixtures("clean_environment")


@pytest.fixture
def server(tmp_path: Path) -> Iterator[ServerProcess]:
    with serving("--speed", "10", data_dir=tmp_path / "data") as running:
        yield running


def _plugpilot(command: str, server: ServerProcess, *options: str) -> Result:
    return CliRunner().invoke(main, [command, f"--data-dir={server.data_dir}", *options])


def test_pair_stop_and_audit_work_beside_a_running_server(server: ServerProcess) -> None:
    pair = _plugpilot("pair", server)
    assert pair.exit_code == 0, pair.output
    address = pair.output.splitlines()[0].removeprefix(INVITATION)
    assert address.startswith(f"{server.url}/#pair=")
    secret = {"secret": address.split("=")[1]}
    owner = httpx.Client(base_url=f"{server.url}/api/v1/", trust_env=False)
    with owner:
        session = owner.post("access/pairing", json=secret).json()
        assert session["person"]["role"] == "owner"
        assert owner.post("access/pairing", json=secret).json()["code"] == "invitation"

        assert _plugpilot("stop", server).output == "Stopped. The robot says: stopped.\n"
        run = _plugpilot("stop", server, "--emergency")
        assert run.output == "Stopped. The robot says: emergency_stop.\n"
        assert owner.get("robot").json()["mode"] == "emergency_stop"

        exported = owner.get("access/audit/export")
    assert exported.headers["content-disposition"].startswith("attachment")
    entries = [json.loads(line) for line in exported.text.splitlines()]
    events = [entry["event"] for entry in entries]
    assert {"invitation.created", "pairing.done", "pairing.refused", "operation"} <= set(events)
    stops = [entry for entry in entries if entry["event"] == "operation"]
    assert {entry["actor"] for entry in stops} == {"machine"}
    assert secret["secret"] not in exported.text

    file = server.data_dir.parent / "exported.jsonl"
    file.write_text(exported.text)
    whole = _plugpilot("audit", server, "--check", "--file", str(file))
    assert whole.output == f"{len(entries)} entries, the chain is whole.\n"
    file.write_text(exported.text.replace('"machine"', '"person: Eve"', 1))
    broken = _plugpilot("audit", server, "--check", "--file", str(file))
    assert broken.exit_code == 1
    assert "tampered" in broken.output


def test_without_a_server_the_commands_say_what_to_do(tmp_path: Path) -> None:
    run = CliRunner().invoke(main, ["stop", f"--data-dir={tmp_path}"])
    assert run.exit_code == 2
    assert "emergency stop button" in run.output
    run = CliRunner().invoke(main, ["pair", f"--data-dir={tmp_path}"])
    assert run.exit_code == 0
    assert "start it first" in run.output
    assert "/#pair=" in run.output
