"""The other end of a notification: a browser that decrypts, and its push service with TLS."""

from __future__ import annotations

import asyncio
import base64
import contextlib
import json
import secrets
import ssl
from collections.abc import AsyncIterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.hazmat.primitives.ciphers.aead import AESGCM
from cryptography.hazmat.primitives.hashes import SHA256
from cryptography.hazmat.primitives.hmac import HMAC
from cryptography.hazmat.primitives.serialization import Encoding, PublicFormat
from fastapi import FastAPI, Request, Response

from server.schema.push import PushLanguage, PushSubscription
from server.tls.authority import Authority
from server.tls.places import ROOT_FILE
from tests.support.fake_stations.serving import serving


def _hmac(key: bytes, data: bytes) -> bytes:
    mac = HMAC(key, SHA256())
    mac.update(data)
    return mac.finalize()


class PushBrowser:
    """Decrypts as RFC 8188 and RFC 8291 say, step by step and by HMAC alone."""

    def __init__(self) -> None:
        self._key = ec.generate_private_key(ec.SECP256R1())
        public = self._key.public_key()
        self.public_key = public.public_bytes(Encoding.X962, PublicFormat.UncompressedPoint)
        self.auth_secret = secrets.token_bytes(16)

    def subscription(self, endpoint: str, language: PushLanguage = "en") -> PushSubscription:
        """What its pushManager would give."""
        return PushSubscription(
            endpoint=endpoint,
            p256dh=base64.urlsafe_b64encode(self.public_key).rstrip(b"=").decode(),
            auth=base64.urlsafe_b64encode(self.auth_secret).rstrip(b"=").decode(),
            language=language,
        )

    def read(self, body: bytes) -> bytes:
        """The message in a body."""
        salt, size, length = body[:16], int.from_bytes(body[16:20], "big"), body[20]
        sender, record = body[21 : 21 + length], body[21 + length :]
        assert len(record) <= size
        point = ec.EllipticCurvePublicKey.from_encoded_point(ec.SECP256R1(), sender)
        shared = self._key.exchange(ec.ECDH(), point)
        prk = _hmac(self.auth_secret, shared)
        material = _hmac(prk, b"WebPush: info\x00" + self.public_key + sender + b"\x01")
        prk = _hmac(salt, material)
        key = _hmac(prk, b"Content-Encoding: aes128gcm\x00\x01")[:16]
        nonce = _hmac(prk, b"Content-Encoding: nonce\x00\x01")[:12]
        plain = AESGCM(key).decrypt(nonce, record, None).rstrip(b"\x00")
        assert plain[-1:] == b"\x02", "not the last record"
        return plain[:-1]


@dataclass
class Pushed:
    """One message that came."""

    path: str
    headers: dict[str, str]
    body: bytes


@dataclass
class PushServiceStage:
    """A push service: answers what it is told to, the last answer for ever."""

    url: str = ""
    trusted: ssl.SSLContext = field(default_factory=ssl.create_default_context)
    answers: list[int] = field(default_factory=lambda: [201])
    received: list[Pushed] = field(default_factory=list)
    arrived: asyncio.Event = field(default_factory=asyncio.Event)

    def app(self) -> FastAPI:
        """It as an application."""
        app = FastAPI()

        @app.post("/{path:path}")
        async def take(path: str, request: Request) -> Response:
            self.received.append(Pushed(path, dict(request.headers), await request.body()))
            self.arrived.set()
            return Response(
                status_code=self.answers.pop(0) if len(self.answers) > 1 else self.answers[0]
            )

        return app

    async def wait(self, count: int) -> None:
        """Until so many messages have come."""
        async with asyncio.timeout(20):
            while len(self.received) < count:
                self.arrived.clear()
                await self.arrived.wait()

    def messages(self, browser: PushBrowser) -> list[dict[str, Any]]:
        """What the browser shows."""
        return [json.loads(browser.read(each.body)) for each in self.received]


@contextlib.asynccontextmanager
async def push_service(folder: Path) -> AsyncIterator[PushServiceStage]:
    """A push service on a real socket, by https with an authority of its own."""
    authority = Authority(folder)
    stage = PushServiceStage()
    stage.trusted = ssl.create_default_context(cafile=str(folder / ROOT_FILE))
    async with serving(stage.app(), certificate=authority.issue(["127.0.0.1"])) as url:
        stage.url = url
        yield stage
