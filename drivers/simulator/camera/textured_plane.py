"""Flat things in front of the camera: a texture on a plane, blurred as the lens would."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from drivers.simulator.camera.ray_grid import RayGrid, Region
from drivers.simulator.view import Pose

ROWS_AT_ONCE = 64
"""Rows drawn in one go: keeps the temporary arrays small."""

_ENOUGH_TEXELS = 3.0  # per standard deviation of a blur

Canvas = NDArray[np.float32]


@dataclass(frozen=True, slots=True, eq=False)
class PlaneTexture:
    """A picture in the plane z = 0 of its own frame, its middle in the origin, y down.

    Attributes:
        reflectance: Times alpha, shape (h, w), 0 to 1.
        alpha: 1 covers, 0 is transparent, shape (h, w).
        texel_mm: Side of one texel.
    """

    reflectance: NDArray[np.float32]
    alpha: NDArray[np.float32]
    texel_mm: float

    def blurred(
        self, sigma_px: float, motion_mm: tuple[float, float], px_per_mm: float
    ) -> PlaneTexture:
        """The texture as lens and motion smear it.

        Blurring the texture with the image of the lens blur is the same as blurring the picture,
        because over the few pixels of a blur the projection is affine, and it leaves no
        aliasing behind.

        Args:
            sigma_px: Standard deviation of the blur in the picture.
            motion_mm: Way of the plane during the exposure along its x and y.
            px_per_mm: Scale of the picture at the plane.
        """
        sigma = sigma_px / (px_per_mm * self.texel_mm)
        if sigma >= 3 * _ENOUGH_TEXELS:
            coarser = self._reduced(int(sigma / _ENOUGH_TEXELS))
            return coarser.blurred(sigma_px, motion_mm, px_per_mm)
        # Linear interpolation makes a ramp of one texel, variance 1/12, of a step between two.
        sigma = float(np.sqrt(max(sigma**2 - 1 / 12, 0.05)))
        way = np.array(motion_mm) / self.texel_mm
        margin = int(np.ceil(3.5 * sigma + np.abs(way).max() / 2)) + 1
        layers = []
        for layer in (self.reflectance, self.alpha):
            padded = np.pad(layer, margin)
            smooth = cv2.GaussianBlur(padded, (0, 0), sigma, borderType=cv2.BORDER_CONSTANT)
            layers.append(_smeared(np.asarray(smooth, dtype=np.float32), way))
        return PlaneTexture(layers[0], layers[1], self.texel_mm)

    def _reduced(self, factor: int) -> PlaneTexture:
        """The same picture in texels larger by the factor, or by one less if that is even.

        By an odd number, equal margins on both sides can always make the size a multiple, so
        that the middle stays where it was.
        """
        factor -= 1 - factor % 2
        margins = []
        for size in self.alpha.shape:
            missing = -size % factor
            margins.append((missing if missing % 2 == 0 else missing + factor) // 2)
        layers = []
        for layer in (self.reflectance, self.alpha):
            whole = np.pad(layer, [(margin, margin) for margin in margins])
            size = (whole.shape[1] // factor, whole.shape[0] // factor)
            reduced = cv2.resize(whole, size, interpolation=cv2.INTER_AREA)
            layers.append(np.asarray(reduced, dtype=np.float32))
        return PlaneTexture(layers[0], layers[1], self.texel_mm * factor)


def draw_plane(
    canvas: Canvas,
    optics: CameraModel,
    grid: RayGrid,
    texture: PlaneTexture,
    T_camera_plane: Pose,
) -> None:
    """Put a plane over what is already on the canvas.

    Args:
        canvas: Reflectance of every pixel, shape (height, width); changed in place.
        optics: The camera.
        grid: Its rays.
        texture: What the plane shows, already blurred.
        T_camera_plane: Pose of the plane, shape (4, 4) [mm].
    """
    region = _region(optics, texture, T_camera_plane)
    if region is None:
        return
    rows, columns = texture.alpha.shape
    to_texel = np.array(
        [
            [1 / texture.texel_mm, 0.0, (columns - 1) / 2],
            [0.0, 1 / texture.texel_mm, (rows - 1) / 2],
            [0.0, 0.0, 1.0],
        ]
    )
    ray_of_plane = T_camera_plane[:3, (0, 1, 3)]
    texel_of_ray = to_texel @ np.linalg.inv(ray_of_plane)
    for top in range(region.top, region.bottom, ROWS_AT_ONCE):
        strip = region._replace(top=top, bottom=min(top + ROWS_AT_ONCE, region.bottom))
        texels = cv2.perspectiveTransform(grid.rays(strip), texel_of_ray)
        x, y = cv2.split(texels)
        reflectance = cv2.remap(texture.reflectance, x, y, cv2.INTER_LINEAR)
        alpha = cv2.remap(texture.alpha, x, y, cv2.INTER_LINEAR)
        below = canvas[strip.top : strip.bottom, strip.left : strip.right]
        below *= 1 - alpha
        below += reflectance


def _region(optics: CameraModel, texture: PlaneTexture, pose: Pose) -> Region | None:
    """Pixels that the plane may cover; None if it is out of the picture or behind the camera."""
    rows, columns = texture.alpha.shape
    x = np.linspace(-0.5, 0.5, 9) * columns * texture.texel_mm
    y = np.linspace(-0.5, 0.5, 9) * rows * texture.texel_mm
    plane = np.stack(np.meshgrid(x, y, [0.0]), axis=-1).reshape(-1, 3)
    in_camera = plane @ pose[:3, :3].T + pose[:3, 3]
    if float(in_camera[:, 2].min()) < 1.0:
        return None
    still = np.zeros(3)
    pixels, _ = cv2.projectPoints(in_camera, still, still, optics.matrix, optics.distortion)
    u, v = np.asarray(pixels).reshape(-1, 2).T
    left, right = max(int(u.min()) - 3, 0), min(int(u.max()) + 4, optics.width)
    top, bottom = max(int(v.min()) - 3, 0), min(int(v.max()) + 4, optics.height)
    return Region(left, top, right, bottom) if left < right and top < bottom else None


def _smeared(layer: NDArray[np.float32], way: NDArray[np.float64]) -> NDArray[np.float32]:
    """Average along a straight way [texels], centred, by its own exact line kernel."""
    length = float(np.hypot(*way))
    if length < 0.05:
        return layer
    half = int(np.ceil(np.abs(way).max() / 2)) + 1
    kernel = np.zeros((2 * half + 1, 2 * half + 1), dtype=np.float32)
    steps = max(int(np.ceil(8 * length)), 2)
    for share in (np.arange(steps) + 0.5) / steps - 0.5:
        x, y = way * share + half
        column, row = int(x), int(y)
        fx, fy = x - column, y - row
        kernel[row, column] += (1 - fx) * (1 - fy)
        kernel[row, column + 1] += fx * (1 - fy)
        kernel[row + 1, column] += (1 - fx) * fy
        kernel[row + 1, column + 1] += fx * fy
    kernel /= kernel.sum()
    smeared = cv2.filter2D(layer, -1, kernel, borderType=cv2.BORDER_CONSTANT)
    return np.asarray(smeared, dtype=np.float32)
