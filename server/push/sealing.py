"""Makes of a message what a push service takes: encrypted, and signed.

Loading the libraries for that takes a while, so this module is loaded when it is first needed.
"""

from __future__ import annotations

from datetime import datetime

from server.push.encryption import encrypt, is_public_key
from server.push.messages import TOPIC, Message
from server.push.store import Subscription
from server.push.vapid import Vapid, new_key

__all__ = ["Sealer", "new_key"]

AUTH_BYTES = 16


class Sealer:
    """The robot, as push services know it.

    Args:
        private_key: 32 bytes, as `new_key` makes them.
        contact: Whom a push service can ask, as mailto: or https: address.
    """

    def __init__(self, private_key: bytes, contact: str) -> None:
        self._vapid = Vapid(private_key, contact)

    @property
    def public_key(self) -> str:
        """The uncompressed point, base64url: what a browser subscribes with."""
        return self._vapid.public_key

    @staticmethod
    def fits(public_key: bytes, auth_secret: bytes) -> bool:
        """Whether these can be the keys of a browser."""
        return is_public_key(public_key) and len(auth_secret) == AUTH_BYTES

    @staticmethod
    def body(message: Message, to: Subscription) -> bytes:
        """The message, for the eyes of one browser."""
        return encrypt(message.payload(to.language), to.public_key, to.auth_secret)

    def headers(self, message: Message, to: Subscription, now: datetime) -> dict[str, str]:
        """What a push service is told."""
        return {
            "Content-Type": "application/octet-stream",
            "Content-Encoding": "aes128gcm",
            "TTL": str(message.ttl_s),
            "Urgency": message.urgency,
            "Topic": TOPIC,
            **self._vapid.headers(to.endpoint, now),
        }
