"""The page: the 3D library's own client with our head, compressed and locked down once."""

from __future__ import annotations

import base64
import gzip
import hashlib
import json
from dataclasses import dataclass
from pathlib import Path

from server.api.twin.client import small_client
from twin.scene.overlays import OVERLAYS

_HERE = Path(__file__).parent
_SCRIPTS = ("head.js", "layers.js", "labels.js", "camera.js", "pick.js", "playback.js")
_STYLES = ("head.css", "layers.css")


@dataclass(frozen=True, slots=True)
class TwinPage:
    """The page as it goes over the wire.

    Attributes:
        gzipped: HTML, gzip.
        etag: Entity tag of the HTML, quoted.
        content_security_policy: Allows these scripts and nothing from elsewhere.
        client: The 3D client that the page fetches, packed for the page's own loader.
    """

    gzipped: bytes
    etag: str
    content_security_policy: str
    client: bytes

    @property
    def html(self) -> bytes:
        """HTML for a client that does not take gzip."""
        return gzip.decompress(self.gzipped)


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


def _own_script() -> str:
    """Our scripts, each in a block of its own, after the list of what can be switched."""
    layers = [
        {"id": each.id, "title": each.title, "nodes": each.nodes, "on": each.shown_at_first}
        for each in OVERLAYS
    ]
    parts = [(_HERE / name).read_text(encoding="utf-8") for name in _SCRIPTS]
    blocks = "".join(f"{{\n{part}}}\n" for part in parts)
    return f'"use strict";\nconst LAYERS = {json.dumps(layers)};\n{blocks}'


def build_page() -> TwinPage:
    """Puts our head into the installed client's page and works out its policy.

    The client is one script that fetches a second one; both are allowed by their hashes.

    Raises:
        ClientPageError: The client was built in another way than the pinned version's.
    """
    client = small_client()
    script = _own_script()
    style = "".join((_HERE / name).read_text(encoding="utf-8") for name in _STYLES)
    sizes = f'data-ss="{client.style_bytes}" data-cs="{len(client.code)}"'
    head = f"<title>Digital twin</title><script>{script}</script><style>{style}</style>"
    loader = f"<script {sizes}>{client.loader}</script>"
    raw = (client.before + head + loader + client.after).encode()
    return TwinPage(
        gzipped=gzip.compress(raw, 9, mtime=0),
        etag=f'"{hashlib.sha256(raw).hexdigest()[:20]}"',
        content_security_policy=_policy([script.encode(), client.loader.encode(), client.code]),
        client=client.packed,
    )
