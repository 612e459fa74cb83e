"""What can be wrong with a picture before anything is looked for in it."""

from __future__ import annotations

import math

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.vision.errors import (
    ImageSizeMismatchError,
    InvalidLabelSizeError,
    NoCodeError,
    PictureTooBrightError,
    PictureTooDarkError,
)

SMALLEST_LABEL_MM, LARGEST_LABEL_MM = 5.0, 1000.0

_DARK_GREY, _BRIGHT_GREY = 30, 250
_STRIDE_PX = 4


def check_label_size(label_size_mm: float) -> None:
    """Let a size pass that a label can have.

    Raises:
        InvalidLabelSizeError: it is not a number, or no size of a label.
    """
    possible = SMALLEST_LABEL_MM <= label_size_mm <= LARGEST_LABEL_MM
    if not (math.isfinite(label_size_mm) and possible):
        detail = (
            f"A label of {label_size_mm:g} mm cannot be: give {SMALLEST_LABEL_MM:g} to "
            f"{LARGEST_LABEL_MM:g} mm."
        )
        raise InvalidLabelSizeError(detail)


def check_picture(image: NDArray[np.uint8]) -> None:
    """Let a grey picture pass.

    Raises:
        ValueError: it is not two-dimensional uint8, or empty.
    """
    if image.ndim != 2 or image.dtype != np.uint8 or image.size == 0:
        message = f"expected a grey uint8 picture, got shape {image.shape} of {image.dtype}"
        raise ValueError(message)


def check_resolution(image: NDArray[np.uint8], camera: CameraModel) -> None:
    """Let a picture pass whose resolution is the camera model's.

    Raises:
        ImageSizeMismatchError: it has another one.
    """
    if image.shape != (camera.height, camera.width):
        detail = (
            f"The picture is {image.shape[1]} x {image.shape[0]} px, but the camera model is "
            f"for {camera.width} x {camera.height} px."
        )
        raise ImageSizeMismatchError(detail)


def no_code(image: NDArray[np.uint8]) -> NoCodeError:
    """The error for a picture without a code: too dark, too bright, or simply none there."""
    sample = np.ascontiguousarray(image[::_STRIDE_PX, ::_STRIDE_PX])
    shares = cv2.calcHist([sample], [0], None, [256], [0, 256]).ravel() / sample.size
    if shares[:_DARK_GREY].sum() > 0.995:
        return PictureTooDarkError("There is hardly any light in the picture.")
    if shares[_BRIGHT_GREY:].sum() > 0.6:
        clipped = float(shares[_BRIGHT_GREY:].sum())
        return PictureTooBrightError(f"{clipped:.0%} of the picture are plain white.")
    return NoCodeError("No code was found in the picture.")
