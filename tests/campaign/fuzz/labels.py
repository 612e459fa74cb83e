"""Texts in labels, and pictures with codes that say anything."""

from __future__ import annotations

import random
import time

import cv2
import numpy as np
import segno
from numpy.typing import NDArray

from server.labels.payload import LabelKey, label_text, parse_label_text
from server.labels.recognise import why_not_the_label
from server.vision.markers.qr_reading import find_codes
from tests.campaign.fuzz.target import BrokenError, mutated

KEY = LabelKey(bytes(range(16)))
WANTED = label_text("zoe", KEY)
TEXTS = (WANTED, "PLUGPILOT:1:zoe", "PP3:zoe:AAAAAAAAAA", "https://example.org/", "")
PICTURE_EVERY = 50
"""A picture takes so many times as long as a text."""


class Labels:
    """Reads what somebody stuck on a car."""

    name = "labels"

    def __init__(self, rng: random.Random) -> None:
        self.tried = 0
        self._rng = rng

    def run(self, until_s: float) -> None:
        """Try texts, and now and then a whole picture."""
        while time.monotonic() < until_s:
            data = mutated(self._rng.choice(TEXTS).encode(), self._rng)
            try:
                _read_text(data.decode("utf-8", errors="replace"))
                if self.tried % PICTURE_EVERY == 0:
                    find_codes(_picture(data, self._rng), wanted=WANTED)
            except Exception as error:
                raise BrokenError(f"{data!r}: {error!r}") from error
            self.tried += 1


def _read_text(text: str) -> None:
    label = parse_label_text(text)
    why_not_the_label([text], WANTED)
    if label is not None and label.intact and text != label_text(label.vehicle, KEY):
        head, signature = text[:-8], text[-8:]
        if label_text(label.vehicle, KEY) == head + signature:
            raise BrokenError(f"{text!r} passes for a label of ours")


def _picture(data: bytes, rng: random.Random) -> NDArray[np.uint8]:
    """A code as large as fits, turned, blurred and damaged."""
    code = segno.make(data[:1000] or b"-", error="q", micro=False)
    modules = np.array([list(row) for row in code.matrix_iter(border=4)], dtype=np.uint8)
    picture = np.where(modules > 0, 0, 255).astype(np.uint8)
    side = rng.randint(100, 400)
    picture = np.asarray(cv2.resize(picture, (side, side), interpolation=cv2.INTER_NEAREST))
    turned = cv2.getRotationMatrix2D((side / 2, side / 2), rng.uniform(-180, 180), 1.0)
    picture = np.asarray(cv2.warpAffine(picture, turned, (side, side), borderValue=255))
    top, left = rng.randrange(side), rng.randrange(side)
    picture[top : top + side // 5, left : left + side // 5] = rng.randrange(256)
    noise = np.random.default_rng(rng.getrandbits(32)).normal(0, rng.uniform(0, 40), picture.shape)
    return np.clip(picture + noise, 0, 255).astype(np.uint8)
