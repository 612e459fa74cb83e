"""Secrets: how they are made and what is kept of them."""

from __future__ import annotations

import hashlib
import secrets

SESSION_BYTES = 32
INVITATION_BYTES = 16
KEY_BYTES = 32
KEY_PREFIX = "plugpilot_"
LONGEST = 128
"""No secret of ours is longer [characters]; what is, need not be looked at."""


def new_session() -> str:
    """The value of a session cookie."""
    return secrets.token_urlsafe(SESSION_BYTES)


def new_invitation() -> str:
    """The secret part of a one-time address: short enough for a QR code that any phone reads."""
    return secrets.token_urlsafe(INVITATION_BYTES)


def new_key() -> str:
    """A key for a machine; its prefix lets scanners of repositories find one that leaked."""
    return KEY_PREFIX + secrets.token_urlsafe(KEY_BYTES)


def digest(secret: str) -> str:
    """What is kept of a secret.

    A plain hash is right here: the secrets are random and long, so there is nothing to guess that
    a slow hash would have to protect, and looking one up by its hash leaks nothing in its timing.
    """
    return hashlib.sha256(secret.encode("utf-8", errors="replace")).hexdigest()
