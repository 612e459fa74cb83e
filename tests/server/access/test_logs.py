"""No secret is written where others can read it."""

from __future__ import annotations

import io
import os
from pathlib import Path

import httpx
import pytest

from server.announcement import FOR_THE_JOURNAL, JOURNAL, goes_to_journal, print_invitation
from tests.support.process import INVITATION, serving

GUESS = "a-guessed-secret-that-is-wrong"


def test_the_log_of_the_real_server_holds_no_secret(
    tmp_path: Path, capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with serving(data_dir=tmp_path / "data") as server:
        secrets = [*server.cookies.values(), GUESS]
        with server.rest() as client:
            body = {"name": "test", "scopes": ["read"]}
            key = client.post("access/keys", json=body).json()["key"]
            secrets.append(key)
            bearer = {"Authorization": f"Bearer {key}x"}
            assert client.get("robot", headers=bearer | {"Cookie": ""}).status_code == 401
            client.post("access/pairing", json={"secret": GUESS})
            client.post("access/login", json={"credential": {"id": GUESS}})
        httpx.get(f"{server.url}/?secret={GUESS}", trust_env=False)
        assert server.stop() == 0
        assert server.process.stdout is not None
        printed = server.process.stdout.read()
        secrets.append(printed.split("#pair=")[1].strip())
    log = capfd.readouterr().err
    trail = (tmp_path / "data" / "plugpilot.sqlite3").read_bytes().decode("latin1")
    for secret in secrets:
        assert secret not in log
        assert secret not in trail
    assert printed.startswith(INVITATION)


def test_into_the_journal_no_invitation_is_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with (tmp_path / "journal").open("w+") as journal:
        status = os.fstat(journal.fileno())
        monkeypatch.setenv(JOURNAL, f"{status.st_dev}:{status.st_ino}")
        assert goes_to_journal(journal)
        print_invitation("http://192.168.1.20:8000", "secret", journal)
        journal.seek(0)
        assert journal.read() == f"{FOR_THE_JOURNAL}\n"
    terminal = io.StringIO()
    print_invitation("http://192.168.1.20:8000", "secret", terminal)
    assert "http://192.168.1.20:8000/#pair=secret" in terminal.getvalue()
