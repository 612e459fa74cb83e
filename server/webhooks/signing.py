"""Signatures of Standard Webhooks 1.0: the receiver can check who sent what, and when."""

from __future__ import annotations

import base64
import secrets
from datetime import datetime

from standardwebhooks import Webhook as Signer

PREFIX = "whsec_"
SECRET_BYTES = 32


def new_secret() -> str:
    """A secret that nobody can guess."""
    return PREFIX + base64.b64encode(secrets.token_bytes(SECRET_BYTES)).decode()


def signed_headers(secret: str, event_id: str, at: datetime, body: str) -> dict[str, str]:
    """The headers of one attempt.

    Args:
        secret: Of the webhook.
        event_id: The same in every attempt, so that a receiver can recognise a repetition.
        at: When this attempt is made; receivers refuse old ones.
        body: What is sent.
    """
    return {
        "webhook-id": event_id,
        "webhook-timestamp": str(int(at.timestamp())),
        "webhook-signature": Signer(secret).sign(event_id, at, body),
    }
