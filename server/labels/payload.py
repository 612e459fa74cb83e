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

from server.labels.errors import (
    DamagedTextError,
    ForeignLabelError,
    ForeignTextError,
    LabelNameError,
    OldLabelError,
)

VERSION = 2
CHECK_CHARACTERS = 2
SIGNATURE_CHARACTERS = 8

_VEHICLE = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]{0,63}")
_TEXT = re.compile(
    rf"PP(?P<version>[0-9]+):(?P<vehicle>{_VEHICLE.pattern}):"
    rf"(?P<check>[A-Z2-7]{{{CHECK_CHARACTERS}}})(?P<signature>[A-Z2-7]{{{SIGNATURE_CHARACTERS}}})"
)
_FIRST_VERSION = re.compile(r"PLUGPILOT:1:.+")
_OTHER_VERSION = re.compile(r"PP([0-9]+):.*")


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


def read_label_text(text: str, key: LabelKey) -> str:
    """The vehicle that a label belongs to.

    Raises:
        ForeignTextError: it is some other text.
        OldLabelError: it is a label of another format.
        DamagedTextError: its check value does not fit.
        ForeignLabelError: it was signed with another key.
    """
    if _FIRST_VERSION.fullmatch(text):
        raise OldLabelError("This label is of the first format, which nobody has signed.")
    match = _TEXT.fullmatch(text)
    other = _OTHER_VERSION.fullmatch(text)
    if other is not None and int(other[1]) != VERSION:
        raise OldLabelError(
            f"This label has format {other[1]}; this version of PlugPilot reads {VERSION}."
        )
    if match is None and other is None:
        raise ForeignTextError(f"The code says {text[:40]!r}.")
    if match is None:
        raise DamagedTextError(f"The text {text[:80]!r} is not complete.")
    body = text[: match.start("check")]
    if match["check"] != _check(body):
        raise DamagedTextError(f"The check value of {text!r} does not fit.")
    if not hmac.compare_digest(match["signature"], _signature(body, key)):
        raise ForeignLabelError(f"The label of {match['vehicle']} was signed with another key.")
    return match["vehicle"]


def _check(body: str) -> str:
    return b32encode(hashlib.sha256(body.encode()).digest()).decode()[:CHECK_CHARACTERS]


def _signature(body: str, key: LabelKey) -> str:
    digest = hmac.digest(key.secret, body.encode(), "sha256")
    return b32encode(digest).decode()[:SIGNATURE_CHARACTERS]
