"""Proves to push services that a message comes from this robot (VAPID, RFC 8292)."""

from __future__ import annotations

import base64
from datetime import datetime, timedelta
from urllib.parse import urlsplit

from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.hazmat.primitives.serialization import Encoding, PublicFormat
from py_vapid import Vapid02

VALID = timedelta(hours=12)
"""Push services take at most a day."""


def new_key() -> bytes:
    """A private key of P-256, 32 bytes."""
    number = ec.generate_private_key(ec.SECP256R1()).private_numbers().private_value
    return number.to_bytes(32, "big")


class Vapid:
    """The identity of this robot at push services.

    Args:
        private_key: 32 bytes, as `new_key` makes them.
        contact: Whom a push service can ask, as mailto: or https: address.
    """

    def __init__(self, private_key: bytes, contact: str) -> None:
        key = ec.derive_private_key(int.from_bytes(private_key, "big"), ec.SECP256R1())
        point = key.public_key().public_bytes(Encoding.X962, PublicFormat.UncompressedPoint)
        self._signer = Vapid02(key)
        self._contact = contact
        self.public_key = base64.urlsafe_b64encode(point).rstrip(b"=").decode()

    def headers(self, endpoint: str, now: datetime) -> dict[str, str]:
        """Headers that sign one request to a push service."""
        parts = urlsplit(endpoint)
        claims = {
            "aud": f"{parts.scheme}://{parts.netloc}",
            "exp": int((now + VALID).timestamp()),
            "sub": self._contact,
        }
        signed: dict[str, str] = self._signer.sign(claims)
        return signed
