"""The page as it goes over the wire."""

from __future__ import annotations

import base64
import hashlib
import json
import math
import re
import subprocess
import sys
from collections.abc import AsyncIterator
from pathlib import Path

import httpx
import pytest
import zstandard
from fastapi import FastAPI

from server.api.twin import client as client_module
from server.api.twin import router as router_module
from server.api.twin import twin_router
from server.api.twin.client import CLIENT_PATH, ClientPageError, unpack_base88
from server.api.twin.page import TwinPage, build_page
from twin.camera_mount import CameraMount
from twin.geometry import RobotGeometry
from twin.scene import TwinHost
from twin.scene.overlays import OVERLAYS


class ReadyHost(TwinHost):
    """A host that says it is ready, or not, without starting anything."""

    is_ready = True

    @property
    def ready(self) -> bool:
        return self.is_ready


@pytest.fixture
def ready_host() -> ReadyHost:
    return ReadyHost(RobotGeometry(), CameraMount(), math.radians(62.2), 4 / 3)


@pytest.fixture
async def client(ready_host: ReadyHost) -> AsyncIterator[httpx.AsyncClient]:
    app = FastAPI()
    app.include_router(twin_router(ready_host))
    async with httpx.AsyncClient(
        transport=httpx.ASGITransport(app), base_url="http://robot"
    ) as client:
        yield client


@pytest.fixture(scope="module")
def page() -> TwinPage:
    return build_page()


def test_base88_makes_four_bytes_of_five_characters() -> None:
    assert unpack_base88("!!!!!") == b"\0\0\0\0"
    assert unpack_base88("!!!!#") == b"\0\0\0\x01"
    assert unpack_base88("!!!#!" + "!!#") == b"\0\0\0\x58" + b"\0\x01"


def test_importing_the_routes_loads_no_3d_library() -> None:
    code = "import sys, server.api.twin; sys.exit('viser' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_our_script_runs_before_the_client(page: TwinPage) -> None:
    html = page.html.decode()
    ours, theirs = html.index("document.hasFocus"), html.index("data-ss=")
    assert html.index("<head>") < ours < theirs


def test_every_script_of_the_page_is_in_its_policy(page: TwinPage) -> None:
    scripts = re.findall(r"<script[^>]*>(.*?)</script>", page.html.decode(), re.DOTALL)
    assert len(scripts) == 2
    for script in scripts:
        digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
        assert f"'sha256-{digest}'" in page.content_security_policy
    # The third is the client itself, which the second one unpacks.
    assert page.content_security_policy.count("'sha256-") == 3
    assert "frame-ancestors 'self'" in page.content_security_policy
    for unsafe in ("'unsafe-inline'", "'unsafe-eval'", "*"):
        (directive,) = re.findall(r"script-src [^;]*", page.content_security_policy)
        assert unsafe not in directive


async def test_it_comes_compressed_to_who_can_read_that(client: httpx.AsyncClient) -> None:
    packed = await client.get("/twin/", headers={"Accept-Encoding": "gzip"})
    plain = await client.get("/twin/", headers={"Accept-Encoding": "identity"})
    assert packed.status_code == plain.status_code == 200
    assert packed.headers["content-encoding"] == "gzip"
    assert "content-encoding" not in plain.headers
    assert packed.text == plain.text
    assert packed.headers["vary"] == "Accept-Encoding"
    assert "default-src 'none'" in packed.headers["content-security-policy"]


async def test_an_unchanged_page_is_not_sent_again(client: httpx.AsyncClient) -> None:
    first = await client.get("/twin/")
    again = await client.get("/twin/", headers={"If-None-Match": first.headers["etag"]})
    assert again.status_code == 304
    assert again.content == b""
    other = await client.get("/twin/", headers={"If-None-Match": '"old"'})
    assert other.status_code == 200


async def test_the_address_without_a_slash_leads_on(client: httpx.AsyncClient) -> None:
    response = await client.get("/twin?theme=light")
    assert response.status_code == 308
    assert response.headers["location"] == "/twin/?theme=light"


async def test_before_the_picture_is_ready_it_asks_to_come_back(
    client: httpx.AsyncClient, ready_host: ReadyHost, monkeypatch: pytest.MonkeyPatch
) -> None:
    ready_host.is_ready = False
    monkeypatch.setattr(router_module, "_READY_WITHIN_S", 0.1)
    response = await client.get("/twin/")
    assert response.status_code == 503
    assert int(response.headers["retry-after"]) > 0
    ready_host.is_ready = True
    assert (await client.get("/twin/")).status_code == 200


@pytest.mark.parametrize(
    ("part", "instead"),
    [
        ('data-p="', 'data-q="'),
        ("const a=de(d.p);", "const a=other(d.p);"),
    ],
)
def test_a_client_built_in_another_way_is_refused(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, part: str, instead: str
) -> None:
    installed = client_module.client_page().read_text(encoding="utf-8")
    other = tmp_path / "index.html"
    monkeypatch.setattr(client_module, "client_page", lambda: other)
    other.write_text(installed.replace(part, instead))
    with pytest.raises(ClientPageError, match="pin viser"):
        build_page()


def test_a_damaged_client_is_refused(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    installed = client_module.client_page().read_text(encoding="utf-8")
    at = installed.index('data-p="') + 5000
    other = tmp_path / "index.html"
    monkeypatch.setattr(client_module, "client_page", lambda: other)
    other.write_text(installed[:at] + "!!!!!" + installed[at + 5 :])
    with pytest.raises(ClientPageError):
        build_page()


@pytest.mark.parametrize("hook", ["_TEST_HOOK", "_SURROUNDINGS"])
def test_a_client_that_changed_inside_is_refused(
    monkeypatch: pytest.MonkeyPatch, hook: str
) -> None:
    absent = {"_TEST_HOOK": b"no such text", "_SURROUNDINGS": re.compile(b"no such text")}
    monkeypatch.setattr(client_module, hook, absent[hook])
    with pytest.raises(ClientPageError, match="changed inside"):
        build_page()


async def test_the_client_comes_once_for_all_time(
    client: httpx.AsyncClient, page: TwinPage
) -> None:
    (address,) = re.findall(rf'fetch\("({CLIENT_PATH}[^"]*)"\)', page.html.decode())
    packed = await client.get(f"/twin/{address}")
    assert packed.status_code == 200
    assert packed.content == page.client
    assert "immutable" in packed.headers["cache-control"]


def test_the_loader_can_unpack_what_it_fetches(page: TwinPage) -> None:
    raw = zstandard.ZstdDecompressor().decompress(page.client)
    (style_bytes, code_bytes) = (
        int(re.findall(rf'data-{name}="(\d+)"', page.html.decode())[0]) for name in ("ss", "cs")
    )
    assert len(raw) == style_bytes + code_bytes
    digest = base64.b64encode(hashlib.sha256(raw[style_bytes:]).digest()).decode()
    assert f"'sha256-{digest}'" in page.content_security_policy


def test_what_a_phone_downloads_is_small(page: TwinPage) -> None:
    assert len(page.gzipped) + len(page.client) < 612_000


def test_the_page_lists_the_scenes_overlays(page: TwinPage) -> None:
    (text,) = re.findall(r"const LAYERS = (.*);", page.html.decode())
    assert [each["id"] for each in json.loads(text)] == [each.id for each in OVERLAYS]
