"""The 3D library's own client, taken out of the installed package and made smaller.

The installed page is one script that unpacks a second one from a text attribute. Here that second
one is unpacked, relieved of what this picture never uses, and packed again to be sent as it is:
text that carries bytes is a fifth longer, and no browser takes anything better than gzip from a
plain http address. Every change is made at a place that must be there exactly once, so that
another version of the client is refused instead of broken.
"""

from __future__ import annotations

import base64
import hashlib
import importlib.util
import re
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
import zstandard
from numpy.typing import NDArray

from twin.scene.surroundings import surroundings

CLIENT_PATH = "client.bin"
"""Where the page fetches the packed client, relative to itself."""

_LOADER = re.compile(
    r'<script data-p="(?P<packed>[^"]*)" data-ss="(?P<style>\d+)" data-cs="(?P<code>\d+)">'
    r"(?P<loader>.*?)</script>",
    re.DOTALL,
)
_ALPHABET = (
    "!#$%()*+,-./0123456789:;=?@ABCDEFGHIJKLMNOPQRSTUVWXYZ[\\]^_abcdefghijklmnopqrstuvwxyz{|}~"
)
_PACKED_IN_PAGE = "const a=de(d.p);"
_SPLAT_SORTER = re.compile(
    rb"fetch\((\w+)\)\.then\((\w)=>\2\.arrayBuffer\(\)\)\.then\(\2=>\w+\(\{wasmBinary:\2\}\)\)"
)
_NEVER = b"new Promise(()=>{})"
_WORKER_SOURCE = re.compile(rb'(?<==)"(?:[^"\\]|\\.){10000,}"(?=,\w+=typeof self<`u`&&self\.Blob)')
_WASM = re.compile(rb"(?<=data:application/wasm;base64,)[A-Za-z0-9+/=]{1000,}")
_SIMPLIFIER = re.compile(
    rb"(?P<start>var e=)`b9H79T[^`]+`(?P<middle>(?:(?!WebAssembly\.instantiate).){0,600}?)"
    rb"WebAssembly\.instantiate\(i\(e\),\{\}\)",
    re.DOTALL,
)
"""What makes coarser copies of meshes for far away; every mesh here says that it wants none."""
_SURROUNDINGS = re.compile(rb"(?<==`data:image/jpeg;base64,)[A-Za-z0-9+/=]{1000,}")
_TEST_HOOK = b"r.__viserSceneTree={getState:"
_TEST_HOOK_WITH_ACTIONS = b"r.__viserSceneTree={actions:e.sceneTreeActions,getState:"
_CONTROL_PANEL = re.compile(rb"[^{}]*\.m_[0-9a-f]{6,8}[^{}]*\{[^{}]*\}")
"""Style rules of the control panel's parts; this page shows no control panel."""
_LEVEL = 19
_SURROUNDINGS_QUALITY = 90


class ClientPageError(RuntimeError):
    """The installed 3D client is not built the way this module knows."""


@dataclass(frozen=True, slots=True)
class Client:
    """The client in the parts that a page needs.

    Attributes:
        before: HTML before the loader.
        after: HTML after it.
        loader: Script that fetches `packed`, unpacks it and starts the code. It reads the sizes
            of style and code from its own element.
        style_bytes: Length of the style sheet, the first part of what is packed.
        code: The client's script, the second part.
        packed: Style sheet and code, zstd.
    """

    before: str
    after: str
    loader: str
    style_bytes: int
    code: bytes
    packed: bytes


def client_page() -> Path:
    """The installed client's page, found without loading the 3D library."""
    spec = importlib.util.find_spec("viser")
    if spec is None or spec.origin is None:
        msg = "The 3D client is not installed; install viser."
        raise ClientPageError(msg)
    return Path(spec.origin).parent / "client" / "build" / "index.html"


def small_client() -> Client:
    """Takes the installed client apart and makes it smaller.

    Left out are the style of the control panel, the sorter of point splats, the simplifier of
    meshes and the photographed surroundings that metal mirrors; a garage of our own, a tenth of
    the size, takes their place.
    Opened up is the store of the scene's nodes, which the client shows to its tests: with its
    actions the page can hide nodes for one viewer alone.

    Raises:
        ClientPageError: The client was built in another way than the pinned version's.
    """
    html = client_page().read_text(encoding="utf-8")
    found = _LOADER.search(html)
    if found is None or found["loader"].count(_PACKED_IN_PAGE) != 1:
        msg = "The 3D client's page has changed; pin viser to the version in pyproject.toml."
        raise ClientPageError(msg)
    style, code = _unpacked(found["packed"], int(found["style"]), int(found["code"]))
    style, code = _CONTROL_PANEL.sub(b"", style), _without_waste(code)
    packed = zstandard.ZstdCompressor(level=_LEVEL).compress(style + code)
    # Another client has another address, so that browsers may keep this one for ever.
    address = f"{CLIENT_PATH}?{hashlib.sha256(packed).hexdigest()[:12]}"
    fetched = f'const a=new Uint8Array(await(await fetch("{address}")).arrayBuffer());'
    return Client(
        before=html[: found.start()],
        after=html[found.end() :],
        loader=found["loader"].replace(_PACKED_IN_PAGE, fetched),
        style_bytes=len(style),
        code=code,
        packed=packed,
    )


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


def _unpacked(packed: str, style_bytes: int, code_bytes: int) -> tuple[bytes, bytes]:
    try:
        raw = zstandard.ZstdDecompressor().decompress(
            unpack_base88(packed), max_output_size=style_bytes + code_bytes
        )
    except zstandard.ZstdError as error:
        msg = "The 3D client's page cannot be unpacked; reinstall viser."
        raise ClientPageError(msg) from error
    if len(raw) != style_bytes + code_bytes:
        msg = "The 3D client's page has an unexpected length; reinstall viser."
        raise ClientPageError(msg)
    return raw[:style_bytes], raw[style_bytes:]


def _without_waste(code: bytes) -> bytes:
    _, encoded = cv2.imencode(
        ".jpg", surroundings(), [cv2.IMWRITE_JPEG_QUALITY, _SURROUNDINGS_QUALITY]
    )
    garage = base64.b64encode(encoded.tobytes())
    code = _WORKER_SOURCE.sub(lambda found: b'""' if b"Sorter" in found[0] else found[0], code)
    code, sorters = _SPLAT_SORTER.subn(_NEVER, code)
    code = _WASM.sub(b"", code)
    code, simplifiers = _SIMPLIFIER.subn(rb"\g<start>``\g<middle>" + _NEVER, code)
    code, pictures = _SURROUNDINGS.subn(garage, code)
    hooks = code.count(_TEST_HOOK)
    if (sorters, simplifiers, pictures, hooks) != (1, 1, 1, 1):
        msg = "The 3D client has changed inside; pin viser to the version in pyproject.toml."
        raise ClientPageError(msg)
    return code.replace(_TEST_HOOK, _TEST_HOOK_WITH_ACTIONS)
