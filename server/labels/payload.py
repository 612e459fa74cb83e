"""The text in a label: which vehicle it belongs to, and who made it.

``PP2:<vehicle>:<check><signature>``

- ``PP`` names the project, ``2`` the version of this format.
- the vehicle's id, as its owner chose it;
- two characters that check the text: the first 10 bits of its SHA-256, in base 32 (RFC 4648);
- eight characters that sign it: the first 40 bits of HMAC-SHA-256 with the key of the
  installation, in base 32. Who has no key of this robot guesses one in 2^40, and can ask only the
  robot itself.

A vehicle's id of up to five characters fits into a QR code of version 2, level Q.
"""

from __future__ import annotations

import hashlib
import hmac
import re
from base64 import b32encode
from dataclasses import dataclass

from server.labels.errors import LabelNameError

VERSION = 2
CHECK_CHARACTERS = 2
SIGNATURE_CHARACTERS = 8

_VEHICLE = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]{0,63}")
_TEXT = re.compile(
    rf"PP{VERSION}:(?P<vehicle>{_VEHICLE.pattern}):"
    rf"(?P<check>[A-Z2-7]{{{CHECK_CHARACTERS}}})(?P<signature>[A-Z2-7]{{{SIGNATURE_CHARACTERS}}})"
)
_FIRST_VERSION = re.compile(r"PLUGPILOT:1:.+")
_ANY_VERSION = re.compile(r"PP([0-9]{1,4}):.*")


@dataclass(frozen=True, slots=True)
class LabelKey:
    """The secret of an installation that signs its labels.

    Attributes:
        secret: At least 16 bytes.
    """

    secret: bytes

    def __repr__(self) -> str:
        return "LabelKey(...)"  # a secret has no place in a log


def label_text(vehicle_id: str, key: LabelKey) -> str:
    """The text in the label of a vehicle; the same for the same vehicle and key.

    Raises:
        LabelNameError: this id cannot stand in a label.
    """
    if not _VEHICLE.fullmatch(vehicle_id):
        raise LabelNameError(f"{vehicle_id!r} cannot be the id of a vehicle.")
    body = f"PP{VERSION}:{vehicle_id}:"
    return body + _check(body) + _signature(body, key)


@dataclass(frozen=True, slots=True)
class LabelText:
    """What a label says, whoever made it.

    Attributes:
        version: Of the format.
        vehicle: The id in it; "" in other formats.
        intact: The check value fits.
    """

    version: int
    vehicle: str = ""
    intact: bool = False


def parse_label_text(text: str) -> LabelText | None:
    """Take a label apart; None when it is no label of ours at all."""
    if _FIRST_VERSION.fullmatch(text):
        return LabelText(version=1)
    any_version = _ANY_VERSION.fullmatch(text)
    if any_version is None:
        return None
    version = int(any_version[1])
    match = _TEXT.fullmatch(text)
    if version != VERSION or match is None:
        return LabelText(version)
    intact = match["check"] == _check(text[: match.start("check")])
    return LabelText(version, match["vehicle"], intact)


def _check(body: str) -> str:
    return b32encode(hashlib.sha256(body.encode()).digest()).decode()[:CHECK_CHARACTERS]


def _signature(body: str, key: LabelKey) -> str:
    digest = hmac.digest(key.secret, body.encode(), "sha256")
    return b32encode(digest).decode()[:SIGNATURE_CHARACTERS]
