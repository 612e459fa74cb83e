"""How the built pages are served."""

from __future__ import annotations

import gzip
from pathlib import Path

import httpx
import pytest
from fastapi import FastAPI

from server.api.pages import pages_router

INDEX = b"<!doctype html><title>PlugPilot</title>"
SCREEN = b"<!doctype html><title>Screen</title>"
BENCH = b"<!doctype html><title>Technician</title>"
SCRIPT = b"console.log('plugged in');"


@pytest.fixture
def static_dir(tmp_path: Path) -> Path:
    """A build as Vite leaves it: a packed script, a small style sheet that is not packed."""
    static = tmp_path / "static"
    (static / "assets").mkdir(parents=True)
    _write_packed(static / "index.html", INDEX)
    _write_packed(static / "technician.html", BENCH)
    _write_packed(static / "kiosk.html", SCREEN)
    _write_packed(static / "assets" / "index-a1B2c3.js", SCRIPT)
    (static / "assets" / "index-d4E5f6.css").write_bytes(b"body{}")
    (static / "assets" / "notes.txt").write_bytes(b"not for the world")
    (static / "icons").mkdir()
    (static / "icons" / "icon-192.png").write_bytes(b"PNG")
    (static / "manifest.webmanifest").write_bytes(b"{}")
    _write_packed(static / "worker.js", SCRIPT)
    (tmp_path / "secret.js").write_bytes(b"secret")
    return static


@pytest.fixture
def client(static_dir: Path) -> httpx.AsyncClient:
    """A browser that takes nothing packed unless it says so."""
    return _client(static_dir)


def _client(static_dir: Path) -> httpx.AsyncClient:
    app = FastAPI()
    app.include_router(pages_router(static_dir))
    return httpx.AsyncClient(
        transport=httpx.ASGITransport(app),
        base_url="http://plugpilot.test",
        headers={"accept-encoding": "identity"},
    )


def _write_packed(file: Path, contents: bytes) -> None:
    file.write_bytes(contents)
    file.with_name(file.name + ".gz").write_bytes(gzip.compress(contents))


async def test_home_page_is_checked_for_news_every_time(client: httpx.AsyncClient) -> None:
    response = await client.get("/")
    assert response.status_code == 200
    assert response.content == INDEX
    assert response.headers["content-type"] == "text/html; charset=utf-8"
    assert response.headers["cache-control"] == "no-cache"


async def test_the_technician_has_a_page_of_his_own(client: httpx.AsyncClient) -> None:
    response = await client.get("/technician")
    assert response.content == BENCH
    assert response.headers["cache-control"] == "no-cache"
    assert "default-src 'none'" in response.headers["content-security-policy"]


async def test_the_robots_own_screen_has_a_page(client: httpx.AsyncClient) -> None:
    response = await client.get("/kiosk")
    assert response.content == SCREEN
    assert "default-src 'none'" in response.headers["content-security-policy"]


async def test_unchanged_home_page_is_not_sent_again(
    client: httpx.AsyncClient, static_dir: Path
) -> None:
    tag = (await client.get("/")).headers["etag"]
    again = await client.get("/", headers={"if-none-match": tag})
    assert again.status_code == 304
    assert again.content == b""
    _write_packed(static_dir / "index.html", INDEX + b"<p>new")
    assert (await client.get("/", headers={"if-none-match": tag})).status_code == 200


async def test_policy_lets_no_foreign_or_inline_script_run(client: httpx.AsyncClient) -> None:
    policy = dict(
        directive.strip().split(" ", 1)
        for directive in (await client.get("/")).headers["content-security-policy"].split(";")
    )
    assert policy["default-src"] == "'none'"
    assert policy["script-src"] == policy["style-src"] == policy["connect-src"] == "'self'"
    assert policy["worker-src"] == policy["manifest-src"] == "'self'"
    assert policy["frame-src"] == policy["frame-ancestors"] == "'self'"
    assert not any("unsafe" in value or "*" in value for value in policy.values())


async def test_worker_is_looked_at_every_time_and_may_fetch_the_page_only(
    client: httpx.AsyncClient,
) -> None:
    response = await client.get("/worker.js")
    assert response.content == SCRIPT
    assert response.headers["content-type"] == "text/javascript; charset=utf-8"
    assert response.headers["cache-control"] == "no-cache"
    policy = response.headers["content-security-policy"]
    assert policy == "default-src 'none'; connect-src 'self'"


@pytest.mark.parametrize(
    ("path", "media_type"),
    [
        ("/manifest.webmanifest", "application/manifest+json"),
        ("/icons/icon-192.png", "image/png"),
    ],
)
async def test_what_installs_the_page_is_asked_for_again(
    client: httpx.AsyncClient, path: str, media_type: str
) -> None:
    response = await client.get(path)
    assert response.status_code == 200
    assert response.headers["content-type"] == media_type
    assert "immutable" not in response.headers["cache-control"]


async def test_asset_is_kept_for_ever(client: httpx.AsyncClient) -> None:
    response = await client.get("/assets/index-a1B2c3.js")
    assert response.content == SCRIPT
    assert response.headers["content-type"] == "text/javascript; charset=utf-8"
    assert "immutable" in response.headers["cache-control"]
    assert response.headers["x-content-type-options"] == "nosniff"


@pytest.mark.parametrize("path", ["/", "/assets/index-a1B2c3.js"])
@pytest.mark.parametrize("accepted", ["gzip", "br, gzip;q=0.8", "GZIP , deflate"])
async def test_packed_file_goes_to_those_who_take_it(
    client: httpx.AsyncClient, path: str, accepted: str
) -> None:
    response = await client.get(path, headers={"accept-encoding": accepted})
    assert response.headers["content-encoding"] == "gzip"
    assert response.headers["vary"] == "Accept-Encoding"
    assert response.content in {INDEX, SCRIPT}  # unpacked by the client
    assert int(response.headers["content-length"]) != len(response.content)


@pytest.mark.parametrize("accepted", ["identity", "br", "gzip;q=0", "gzip; q=0.0", "x-gzipped"])
async def test_plain_file_goes_to_all_others(client: httpx.AsyncClient, accepted: str) -> None:
    response = await client.get("/assets/index-a1B2c3.js", headers={"accept-encoding": accepted})
    assert "content-encoding" not in response.headers
    assert response.headers["vary"] == "Accept-Encoding"
    assert response.content == SCRIPT


async def test_file_without_a_packed_one_is_sent_plain(client: httpx.AsyncClient) -> None:
    response = await client.get("/assets/index-d4E5f6.css", headers={"accept-encoding": "gzip"})
    assert "content-encoding" not in response.headers
    assert response.content == b"body{}"


@pytest.mark.parametrize(
    "path",
    [
        "/assets/absent-a1B2c3.js",
        "/assets/notes.txt",
        "/assets/index-a1B2c3.js.gz",
        "/assets/..%2F..%2Fsecret.js",
        "/assets/%2e%2e%2fsecret.js",
        "/assets/.hidden.js",
        "/assets/",
        "/icons/absent.png",
        "/icons/..%2Fworker.js",
        "/manifest.json",
    ],
)
async def test_nothing_but_assets_is_served(client: httpx.AsyncClient, path: str) -> None:
    assert (await client.get(path)).status_code == 404


@pytest.mark.parametrize("path", ["/", "/assets/index-a1B2c3.js"])
async def test_head_tells_the_size_and_sends_nothing(client: httpx.AsyncClient, path: str) -> None:
    response = await client.head(path)
    assert response.status_code == 200
    assert response.content == b""
    assert response.headers["content-length"] == (await client.get(path)).headers["content-length"]


async def test_missing_build_says_what_to_do_and_heals_without_a_restart(tmp_path: Path) -> None:
    static = tmp_path / "static"
    client = _client(static)
    response = await client.get("/")
    assert response.status_code == 503
    assert "make setup" in response.text
    assert response.headers["cache-control"] == "no-cache"
    static.mkdir()
    (static / "index.html").write_bytes(INDEX)
    assert (await client.get("/")).content == INDEX
