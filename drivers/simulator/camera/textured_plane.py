"""Flat things in front of the camera: a texture on a plane, blurred as the lens would."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from drivers.simulator.camera.blur_kernels import disc_kernel, line_kernel
from drivers.simulator.camera.coarse_grid import CoarseGrid, Field, Region
from drivers.simulator.camera.label_condition import FLAT, LabelCondition
from drivers.simulator.camera.row_motion import RowMotion
from drivers.simulator.view import Pose

ROWS_AT_ONCE = 64
"""Rows drawn in one go: keeps the temporary arrays small."""

STRIDE_PX = 2
"""Where a pixel's ray meets a plane is worked out at every second pixel of every second row.
Interpolation is then good to tan(tilt) / f pixels: 3e-4 at 20 degrees and f = 1360 px."""

_ENOUGH_TEXELS = 3.0  # per standard deviation of a blur
_SMALL_DISC_TEXELS = 6.0  # a Gaussian of the same variance is nearer to it than its texels are

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

    def blurred(self, lens_px: float, disc_px: float, px_per_mm: float) -> PlaneTexture:
        """The texture as the lens smears it.

        Blurring the texture with the image of the lens blur is the same as blurring the picture,
        because over the few pixels of a blur the projection is affine, and it leaves no
        aliasing behind.

        Args:
            lens_px: Standard deviation of the blur of lens and pixel in the picture.
            disc_px: Diameter of the circle of confusion in the picture.
            px_per_mm: Scale of the picture at the plane.
        """
        texel_px = px_per_mm * self.texel_mm
        whole = float(np.hypot(lens_px, disc_px / 4)) / texel_px
        if whole >= 3 * _ENOUGH_TEXELS:
            coarser = self._reduced(int(whole / _ENOUGH_TEXELS))
            return coarser.blurred(lens_px, disc_px, px_per_mm)
        disc = disc_px / texel_px
        sigma = lens_px / texel_px
        if disc < _SMALL_DISC_TEXELS:
            sigma, disc = whole, 0.0
        # Linear interpolation makes a ramp of one texel, variance 1/12, of a step between two.
        # A disc gathered into whole texels is wider by as much.
        surplus = 2 / 12 if disc else 1 / 12
        sigma = float(np.sqrt(max(sigma**2 - surplus, 0.05)))
        margin = int(np.ceil(3.5 * sigma + disc / 2)) + 1
        layers = []
        for layer in (self.reflectance, self.alpha):
            padded = np.pad(layer, margin)
            smooth = cv2.GaussianBlur(padded, (0, 0), sigma, borderType=cv2.BORDER_CONSTANT)
            if disc:
                kernel = disc_kernel(disc)
                smooth = cv2.filter2D(smooth, -1, kernel, borderType=cv2.BORDER_CONSTANT)
            layers.append(np.asarray(smooth, dtype=np.float32))
        return PlaneTexture(layers[0], layers[1], self.texel_mm)

    def smeared(self, way_mm: tuple[float, float]) -> PlaneTexture:
        """The texture as motion at constant velocity smears it during the exposure.

        Args:
            way_mm: Way of the plane during the exposure along its x and y.
        """
        kernel = line_kernel(np.array(way_mm) / self.texel_mm)
        if kernel is None:
            return self
        margin = kernel.shape[0] // 2 + 1
        layers = []
        for layer in (self.reflectance, self.alpha):
            padded = np.pad(layer, margin)
            smeared = cv2.filter2D(padded, -1, kernel, borderType=cv2.BORDER_CONSTANT)
            layers.append(np.asarray(smeared, dtype=np.float32))
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


@dataclass(frozen=True, slots=True, eq=False)
class PlacedPlane:
    """Where one plane is, and what it is like besides its texture.

    Attributes:
        T_camera_plane: Its pose, shape (4, 4) [mm].
        condition: Its true size and shape.
        half_mm: Half its side, where it can be bent.
        gloss: What it mirrors, at the nodes of a grid; None where that is nothing.
    """

    T_camera_plane: Pose
    condition: LabelCondition = FLAT
    half_mm: float = 0.0
    gloss: tuple[CoarseGrid, Field] | None = None


def draw_plane(
    canvas: Canvas,
    grid: CoarseGrid,
    texture: PlaneTexture,
    plane: PlacedPlane,
    rows: RowMotion,
) -> None:
    """Put a plane over what is already on the canvas.

    Args:
        canvas: Reflectance of every pixel, shape (height, width); changed in place.
        grid: Rays of the camera, at every second pixel.
        texture: What the plane shows, already blurred.
        plane: The plane.
        rows: Where each row sees it.
    """
    region = _region(grid.optics, texture, plane, rows)
    if region is None:
        return
    x, y = _texels(grid, region, texture, plane, rows)
    first = region.top // STRIDE_PX
    layers = cv2.merge((texture.reflectance, texture.alpha))
    for top in range(region.top, region.bottom, ROWS_AT_ONCE):
        strip = region._replace(top=top, bottom=min(top + ROWS_AT_ONCE, region.bottom))
        nodes = grid.around(strip)[0]
        here = slice(nodes.start - first, nodes.stop - first)
        x_texel, y_texel = (grid.enlarged_part(part[here], strip) for part in (x, y))
        shown, alpha = cv2.split(cv2.remap(layers, x_texel, y_texel, cv2.INTER_LINEAR))
        below = canvas[strip.top : strip.bottom, strip.left : strip.right]
        below *= 1 - alpha
        below += shown
        if plane.gloss is not None:
            coarse, field = plane.gloss
            below += alpha * coarse.enlarged_part(field[coarse.around(strip)], strip)


def _texels(
    grid: CoarseGrid,
    region: Region,
    texture: PlaneTexture,
    plane: PlacedPlane,
    rows: RowMotion,
) -> tuple[Field, Field]:
    """Which texels the rays around a region meet: their columns and rows, at the grid's nodes."""
    pose, condition = plane.T_camera_plane, plane.condition
    nodes = grid.around(region)
    rays = np.ascontiguousarray(grid.rays[nodes], dtype=np.float32)
    places = cv2.perspectiveTransform(rays, np.linalg.inv(pose[:3, (0, 1, 3)]))
    x, y = (np.asarray(part, dtype=np.float32) for part in cv2.split(places))
    if not rows.still:
        rows.correct(x, y, grid.v_px[nodes[0]], pose)
    if not condition.flat:
        x, y = condition.bend(x, y, plane.half_mm, -pose[:3, :3].T @ pose[:3, 3])
    height, width = texture.alpha.shape
    x = x * np.float32(1 / (texture.texel_mm * condition.width_scale))
    y = y * np.float32(1 / (texture.texel_mm * condition.height_scale))
    return x + np.float32((width - 1) / 2), y + np.float32((height - 1) / 2)


def _region(
    optics: CameraModel, texture: PlaneTexture, plane: PlacedPlane, rows: RowMotion
) -> Region | None:
    """Pixels that the plane may cover; None if it is out of the picture or behind the camera."""
    pose = plane.T_camera_plane
    grown = 1.01 * max(plane.condition.width_scale, plane.condition.height_scale)
    height, width = texture.alpha.shape
    x = np.linspace(-0.5, 0.5, 9) * width * texture.texel_mm * grown
    y = np.linspace(-0.5, 0.5, 9) * height * texture.texel_mm * grown
    points = np.stack(np.meshgrid(x, y, [0.0]), axis=-1).reshape(-1, 3)
    in_camera = points @ pose[:3, :3].T + pose[:3, 3]
    if not rows.still:
        in_camera = (in_camera + rows.extremes_mm[:, None]).reshape(-1, 3)
    if float(in_camera[:, 2].min()) < 1.0:
        return None
    still = np.zeros(3)
    pixels, _ = cv2.projectPoints(in_camera, still, still, optics.matrix, optics.distortion)
    u, v = np.asarray(pixels).reshape(-1, 2).T
    left, right = max(int(u.min()) - 3, 0), min(int(u.max()) + 4, optics.width)
    top, bottom = max(int(v.min()) - 3, 0), min(int(v.max()) + 4, optics.height)
    return Region(left, top, right, bottom) if left < right and top < bottom else None
