"""The web pages: built files of ``web/``, served with strict headers and ready-made compression."""

from __future__ import annotations

import hashlib
import re
from pathlib import Path

from fastapi import APIRouter, Request, Response
from fastapi.responses import HTMLResponse

CONTENT_SECURITY_POLICY = (
    "default-src 'none'; "
    "script-src 'self'; "
    "style-src 'self'; "
    "img-src 'self' data: blob:; "
    "connect-src 'self'; "
    "frame-src 'self'; "
    "worker-src 'self'; "
    "manifest-src 'self'; "
    "frame-ancestors 'self'; "
    "base-uri 'none'; "
    "form-action 'none'"
)
"""Only what the pages need; the twin in its frame brings its own policy."""

_PAGE_HEADERS = {
    "Content-Security-Policy": CONTENT_SECURITY_POLICY,
    "Cache-Control": "no-cache",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}
_ASSET_HEADERS = {
    # The name holds a hash of the contents: the file never changes.
    "Cache-Control": "public, max-age=31536000, immutable",
    "X-Content-Type-Options": "nosniff",
}
_WORKER_HEADERS = {
    # It fetches the page for itself, and does nothing else.
    "Content-Security-Policy": "default-src 'none'; connect-src 'self'",
    "Cache-Control": "no-cache",
    "X-Content-Type-Options": "nosniff",
}
_ICON_HEADERS = {"Cache-Control": "public, max-age=86400", "X-Content-Type-Options": "nosniff"}
_MEDIA_TYPES = {
    ".css": "text/css; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".svg": "image/svg+xml",
    ".png": "image/png",
    ".webmanifest": "application/manifest+json",
    ".webp": "image/webp",
    ".woff2": "font/woff2",
}
_ASSET_NAME = re.compile(r"[A-Za-z0-9_-][A-Za-z0-9._-]*")

_NOT_BUILT = """<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>PlugPilot: pages not built</title>
<h1>The web pages have not been built</h1>
<p>The server runs, and its API answers under <a href="/api/v1/health">/api/v1</a>.
<p>Run <code>make setup</code> in the project folder, then load this page again.
"""


def pages_router(static_dir: Path) -> APIRouter:
    """Routes of the pages and their assets.

    Files are read for every request, so that a new build shows without a restart.

    Args:
        static_dir: What ``npm run build`` wrote: a file for each page, the service worker, the
            manifest and its icons, and ``assets/`` with hashed names, each with a ``.gz`` beside
            it where that is smaller. When it is missing, the pages answer 503 and say what to do.
    """
    router = APIRouter(include_in_schema=False)

    @router.api_route("/", methods=["GET", "HEAD"])
    def home(request: Request) -> Response:
        return _page(request, static_dir / "index.html")

    @router.api_route("/technician", methods=["GET", "HEAD"])
    def technician(request: Request) -> Response:
        return _page(request, static_dir / "technician.html")

    @router.api_route("/kiosk", methods=["GET", "HEAD"])
    def kiosk(request: Request) -> Response:
        return _page(request, static_dir / "kiosk.html")

    @router.api_route("/assets/{name}", methods=["GET", "HEAD"])
    def asset(request: Request, name: str) -> Response:
        return _file(request, static_dir / "assets", name, _ASSET_HEADERS)

    @router.api_route("/icons/{name}", methods=["GET", "HEAD"])
    def icon(request: Request, name: str) -> Response:
        return _file(request, static_dir / "icons", name, _ICON_HEADERS)

    @router.api_route("/manifest.webmanifest", methods=["GET", "HEAD"])
    def manifest(request: Request) -> Response:
        return _file(request, static_dir, "manifest.webmanifest", _ICON_HEADERS)

    @router.api_route("/worker.js", methods=["GET", "HEAD"])
    def worker(request: Request) -> Response:
        return _file(request, static_dir, "worker.js", _WORKER_HEADERS)

    return router


def _file(request: Request, folder: Path, name: str, headers: dict[str, str]) -> Response:
    file = folder / name
    media_type = _MEDIA_TYPES.get(file.suffix)
    if media_type is None or not _ASSET_NAME.fullmatch(name) or not file.is_file():
        return Response("There is no such file.", status_code=404, media_type="text/plain")
    body, encoding = _contents(request, file)
    return Response(body, media_type=media_type, headers=headers | encoding)


def _page(request: Request, page: Path) -> Response:
    """The page, or 304 when the browser has this very one."""
    if not page.is_file():
        return HTMLResponse(_NOT_BUILT, status_code=503, headers=_PAGE_HEADERS)
    body, encoding = _contents(request, page)
    headers = _PAGE_HEADERS | encoding
    headers["ETag"] = f'"{hashlib.sha256(body).hexdigest()[:32]}"'
    if headers["ETag"] in request.headers.get("if-none-match", ""):
        return Response(status_code=304, headers=headers)
    return HTMLResponse(body, headers=headers)


def _contents(request: Request, file: Path) -> tuple[bytes, dict[str, str]]:
    """Bytes to send and the headers that say how they are packed."""
    packed = file.with_name(file.name + ".gz")
    if not packed.is_file():
        return file.read_bytes(), {}
    if _takes_gzip(request.headers.get("accept-encoding", "")):
        return packed.read_bytes(), {"Content-Encoding": "gzip", "Vary": "Accept-Encoding"}
    return file.read_bytes(), {"Vary": "Accept-Encoding"}


def _takes_gzip(accept_encoding: str) -> bool:
    """Whether the header names gzip with a weight above zero (RFC 9110, 12.5.3)."""
    for part in accept_encoding.lower().split(","):
        coding, _, parameters = part.partition(";")
        if coding.strip() == "gzip":
            return not re.fullmatch(r"\s*q\s*=\s*0(\.0*)?\s*", parameters)
    return False
