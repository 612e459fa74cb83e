"""QR codes as markers: ours and any other."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from server.vision.markers.code import Code, Image
from server.vision.markers.qr_modules import exact_modules
from server.vision.markers.qr_reading import find_codes, read_window
from server.vision.markers.window import window_around


class QrCodes:
    """Finds and reads QR codes; satisfies ``Marker``."""

    def find(self, image: Image, *, wanted: str | None = None) -> list[Code]:
        """QR codes in a picture, largest first, with exact modules where they can be known."""
        return [_exact(code) for code in find_codes(image, wanted=wanted)]

    def find_near(self, image: Image, corners_px: NDArray[np.float64], wanted: str) -> Code | None:
        """The wanted code near where it is expected."""
        window = window_around(image, corners_px)
        if window is None:
            return None
        for code in read_window(window):
            if code.payload == wanted:
                return _exact(code)
        return None


def _exact(code: Code) -> Code:
    if code.mirrored:
        return code
    return replace(code, modules=exact_modules(code.payload, code.modules))
