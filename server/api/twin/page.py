"""The page: the 3D library's own client with our head, compressed and locked down once."""

from __future__ import annotations

import base64
import gzip
import hashlib
import importlib.util
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import zstandard
from numpy.typing import NDArray

_HERE = Path(__file__).parent
_LOADER = re.compile(
    r'<script data-p="(?P<packed>[^"]*)" data-ss="(?P<style>\d+)" data-cs="(?P<code>\d+)">'
    r"(?P<loader>.*?)</script>",
    re.DOTALL,
)
_ALPHABET = (
    "!#$%()*+,-./0123456789:;=?@ABCDEFGHIJKLMNOPQRSTUVWXYZ[\\]^_abcdefghijklmnopqrstuvwxyz{|}~"
)


def _client_page() -> Path:
    """The installed client's page, found without loading the 3D library."""
    spec = importlib.util.find_spec("viser")
    if spec is None or spec.origin is None:
        msg = "The 3D client is not installed; install viser."
        raise ClientPageError(msg)
    return Path(spec.origin).parent / "client" / "build" / "index.html"


class ClientPageError(RuntimeError):
    """The installed 3D client is not built the way this module knows."""


@dataclass(frozen=True, slots=True)
class TwinPage:
    """The page as it goes over the wire.

    Attributes:
        gzipped: HTML, gzip.
        etag: Entity tag of the HTML, quoted.
        content_security_policy: Allows these scripts and nothing from elsewhere.
    """

    gzipped: bytes
    etag: str
    content_security_policy: str

    @property
    def html(self) -> bytes:
        """HTML for a client that does not take gzip."""
        return gzip.decompress(self.gzipped)


def unpack_base88(text: str) -> bytes:
    """Decodes the client's packing: five characters of a base of 88 make four bytes."""
    digit = np.zeros(128, dtype=np.uint64)
    digit[np.frombuffer(_ALPHABET.encode(), dtype=np.uint8)] = np.arange(88)
    digits = digit[np.frombuffer(text.encode("ascii"), dtype=np.uint8)]
    whole, rest = divmod(len(digits), 5)
    powers = np.array([88**4, 88**3, 88**2, 88, 1], dtype=np.uint64)
    words: NDArray[np.uint64] = digits[: whole * 5].reshape(-1, 5) @ powers
    tail = 0
    for value in digits[whole * 5 :]:
        tail = tail * 88 + int(value)
    return words.astype(">u4").tobytes() + tail.to_bytes(max(rest - 1, 0), "big")


def _hash_source(script: bytes) -> str:
    return f"'sha256-{base64.b64encode(hashlib.sha256(script).digest()).decode()}'"


def _policy(scripts: list[bytes]) -> str:
    hashes = " ".join(_hash_source(script) for script in scripts)
    return "; ".join(
        [
            "default-src 'none'",
            f"script-src {hashes} 'wasm-unsafe-eval'",
            "worker-src blob:",
            "style-src 'unsafe-inline'",  # the client writes its styles while it runs
            "img-src 'self' data: blob:",
            "font-src data:",
            "connect-src 'self' data: blob:",
            "frame-ancestors 'self'",
            "base-uri 'none'",
            "form-action 'none'",
        ]
    )


def build_page() -> TwinPage:
    """Puts our head into the installed client's page and works out its policy.

    The client is one script that unpacks a second one; both are allowed by their hashes.

    Raises:
        ClientPageError: The client was built in another way than the pinned version's.
    """
    html = _client_page().read_text(encoding="utf-8")
    found = _LOADER.search(html)
    if found is None:
        msg = "The 3D client's page has changed; pin viser to the version in pyproject.toml."
        raise ClientPageError(msg)
    style_bytes, code_bytes = int(found["style"]), int(found["code"])
    try:
        unpacked = zstandard.ZstdDecompressor().decompress(
            unpack_base88(found["packed"]), max_output_size=style_bytes + code_bytes
        )
    except zstandard.ZstdError as error:
        msg = "The 3D client's page cannot be unpacked; reinstall viser."
        raise ClientPageError(msg) from error
    if len(unpacked) != style_bytes + code_bytes:
        msg = "The 3D client's page has an unexpected length; reinstall viser."
        raise ClientPageError(msg)
    script = (_HERE / "head.js").read_text(encoding="utf-8")
    style = (_HERE / "head.css").read_text(encoding="utf-8")
    head = f"<title>Digital twin</title><script>{script}</script><style>{style}</style>"
    raw = (html[: found.start()] + head + html[found.start() :]).encode()
    return TwinPage(
        gzipped=gzip.compress(raw, 9, mtime=0),
        etag=f'"{hashlib.sha256(raw).hexdigest()[:20]}"',
        content_security_policy=_policy(
            [script.encode(), found["loader"].encode(), unpacked[style_bytes:]]
        ),
    )
