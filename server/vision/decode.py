"""Find and read QR codes in a picture."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial

import cv2
import numpy as np
import zxingcpp
from numpy.typing import NDArray

from server.vision.qr_format import is_mirrored

Image = NDArray[np.uint8]
_FORMATS = zxingcpp.BarcodeFormats([zxingcpp.BarcodeFormat.QRCodeModel2])


_SMALLEST_LOOK_PX, _LARGEST_LOOK_PX = 100, 2600  # longer side of scaled pictures


@dataclass(frozen=True, slots=True, eq=False)
class Code:
    """One QR code found in a picture.

    Attributes:
        payload: Its text, exactly as encoded.
        corners_px: Outer corners of the code without quiet zone in the order top left, top right,
            bottom right, bottom left of the code itself, shape (4, 2) [px], pixel centres at
            integers; good to about 1 px.
        modules: Sampled modules before error correction, True is black, shape (n, n).
        mirrored: The code is seen in a mirror.
    """

    payload: str
    corners_px: NDArray[np.float64]
    modules: NDArray[np.bool_]
    mirrored: bool

    @property
    def area_px(self) -> float:
        """Area of the quadrilateral of the corners [px^2]."""
        return abs(float(cv2.contourArea(self.corners_px.astype(np.float32))))

    def enlarged(self, scale: float, shift_px: tuple[float, float]) -> Code:
        """The code as seen in a picture of which this one's was a scaled part."""
        corners = (self.corners_px + 0.5) / scale - 0.5 + np.array(shift_px)
        return Code(self.payload, corners, self.modules, self.mirrored)


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
