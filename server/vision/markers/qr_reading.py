"""Find and read QR codes in a picture."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

import cv2
import numpy as np
import zxingcpp

from server.vision.markers.code import Code, Image
from server.vision.markers.qr_format import is_mirrored
from server.vision.markers.window import Window

_FORMATS = zxingcpp.BarcodeFormats([zxingcpp.BarcodeFormat.QRCodeModel2])


_SMALLEST_LOOK_PX, _LARGEST_LOOK_PX = 100, 2600  # longer side of scaled pictures


def find_codes(image: Image, *, wanted: str | None = None) -> list[Code]:
    """Find QR codes; try harder, step by step, until something (or the wanted text) is read.

    Args:
        image: Grey values, shape (height, width).
        wanted: Go on until a code with this text is found; None is content with any code.

    Returns:
        Codes of the step that succeeded, largest first; without success every other code that
        was met on the way (empty if there was none).
    """
    met: dict[str, Code] = {}
    for read in _attempts(image):
        codes = sorted(read(), key=lambda code: -code.area_px)
        if any(wanted is None or code.payload == wanted for code in codes):
            return codes
        met.update({code.payload: code for code in codes})
    return list(met.values())


def read_window(window: Window) -> list[Code]:
    """Read what is in a part of a picture, in the coordinates of the whole."""
    codes = _read(window.image, quick=True) or _read(window.image)
    return [code.enlarged(window.scale, window.left_top_px) for code in codes]


def _attempts(image: Image) -> Iterator[Callable[[], list[Code]]]:
    """Readings in the order of their cost; each helps against something the earlier cannot."""
    yield partial(_read, image, quick=True)
    yield partial(_read, image)  # inverted codes and codes larger or blurrier than usual
    yield partial(_read, image, binarizer=zxingcpp.Binarizer.GlobalHistogram)
    yield lambda: _read(np.asarray(cv2.GaussianBlur(image, (0, 0), 1.0), dtype=np.uint8))  # noise
    yield lambda: _read(_equalised(image))  # shadow, glare, low contrast
    longest = max(image.shape)
    for scale in (2.0, 3.0, 0.5, 0.25):  # modules of 1 to 2 px; defocus
        if _SMALLEST_LOOK_PX <= longest * scale <= _LARGEST_LOOK_PX:
            yield partial(_read_scaled, image, scale)


def _read(
    image: Image,
    *,
    quick: bool = False,
    binarizer: zxingcpp.Binarizer = zxingcpp.Binarizer.LocalAverage,
) -> list[Code]:
    """One pass of zxing-cpp; quick leaves out the inverted and the downscaled pictures."""
    found = zxingcpp.read_barcodes(
        image,
        _FORMATS,
        try_downscale=not quick,
        try_invert=not quick,
        text_mode=zxingcpp.TextMode.Plain,
        binarizer=binarizer,
    )
    return [_code(barcode) for barcode in found]


def _code(barcode: zxingcpp.Barcode) -> Code:
    place = barcode.position
    corners = [place.top_left, place.top_right, place.bottom_right, place.bottom_left]
    # zxing-cpp counts from the top left corner of the first pixel, this project from its centre.
    corners_px = np.array([(corner.x - 0.5, corner.y - 0.5) for corner in corners])
    modules = np.asarray(barcode.to_image(scale=1, add_quiet_zones=False)) == 0
    return Code(barcode.text, corners_px, modules, is_mirrored(modules))


def _equalised(image: Image) -> Image:
    clahe = cv2.createCLAHE(clipLimit=4.0, tileGridSize=(8, 8))
    return np.asarray(clahe.apply(image), dtype=np.uint8)


def _read_scaled(image: Image, scale: float) -> list[Code]:
    method = cv2.INTER_AREA if scale < 1 else cv2.INTER_CUBIC
    resized = cv2.resize(image, None, fx=scale, fy=scale, interpolation=method)
    codes = _read(np.asarray(resized, dtype=np.uint8))
    return [code.enlarged(scale, (0.0, 0.0)) for code in codes]
