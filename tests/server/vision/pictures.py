"""Pictures of labels with known poses, for the tests of the locator."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel, pi_camera_v2
from drivers.simulator.camera.imaging import ImagingParameters
from drivers.simulator.camera.renderer import Renderer
from drivers.simulator.view import CameraView
from server.vision.projection import Array, rotation_matrix, rotation_vector

PAYLOAD = "PLUGPILOT:1:7F3K22Q9"
SIZE_MM = 60.0
OPTICS = pi_camera_v2().model_copy(update={"cx": 822.7, "cy": 613.4, "p2": -1e-4})
"""Off its centre in every way, so that no symmetry hides a mistake."""


def pose(
    translation_mm: Sequence[float] | Array, tilt_deg: Sequence[float] | Array = (0.0, 0.0, 0.0)
) -> NDArray[np.float64]:
    """A pose from a translation [mm] and a rotation vector [degrees]."""
    result = np.eye(4)
    result[:3, :3] = rotation_matrix(np.radians(tilt_deg))
    result[:3, 3] = translation_mm
    return result


def view(
    T_camera_label: Array,
    *,
    payload: str = PAYLOAD,
    velocity_mm_s: Sequence[float] = (0.0, 0.0, 0.0),
) -> CameraView:
    """A car whose socket is 120 mm beside the label; the plug is out of the picture."""
    beside = np.eye(4)
    beside[:3, 3] = 120.0, 15.0, 0.0
    return CameraView(
        T_camera_label=T_camera_label,
        T_camera_socket=T_camera_label @ beside,
        T_camera_plug=pose((500.0, 0.0, 100.0)),
        label_velocity_mm_s=np.array(velocity_mm_s),
        payload=payload,
        label_size_mm=SIZE_MM,
    )


@cache
def renderer(**imaging: float) -> Renderer:
    """A renderer with the default optics; they are costly to make, so they are kept."""
    return Renderer(OPTICS, ImagingParameters(**imaging), seed=7)


def picture(scene: CameraView, number: int = 0, **imaging: float) -> NDArray[np.uint8]:
    """Render a scene with the default camera; keywords change its imaging parameters."""
    return renderer(**imaging).picture(scene, number)


def pose_error(found: Array, true: Array) -> Array:
    """The (omega [rad], tau [mm]) that leads from the true pose to the found one, shape (6,)."""
    turn = rotation_vector(found[:3, :3] @ true[:3, :3].T)
    return np.concatenate((turn, found[:3, 3] - true[:3, 3]))


def random_pose(rng: np.random.Generator, nearest_mm: float, farthest_mm: float) -> Array:
    """A label in the inner part of the picture, tilted by up to 4 degrees, any side up."""
    z = rng.uniform(nearest_mm, farthest_mm)
    room = max(0.30 * z - 30.0, 4.0)
    tilt = np.degrees(rng.uniform(-0.07, 0.07, 3))
    tilt[2] += 90.0 * rng.integers(4)
    return pose((*rng.uniform(-room, room, 2), z), tilt)


def flat_code(
    modules: NDArray[np.bool_], module_px: int, margin: int = 4, black: int = 20, white: int = 230
) -> NDArray[np.uint8]:
    """A code seen exactly head-on, every module a square of whole pixels."""
    framed = np.pad(modules, margin)
    grey = np.where(framed, black, white).astype(np.uint8)
    return grey.repeat(module_px, axis=0).repeat(module_px, axis=1)


def ideal_picture(
    camera: CameraModel, modules: NDArray[np.bool_], T_camera_label: Array, fineness: int
) -> NDArray[np.uint8]:
    """Brute force: every pixel is the mean of fineness^2 rays; pinhole only, then a tone curve.

    Deliberately written without any part of the renderer or the locator: pixel (u, v) collects
    the light from u - 1/2 to u + 1/2, so its centre is at integer coordinates.
    """
    image = np.zeros((camera.height, camera.width), dtype=np.uint8)
    steps = (np.arange(fineness) + 0.5) / fineness - 0.5
    x = ((np.arange(camera.width)[:, None] + steps).ravel() - camera.cx) / camera.fx
    count = modules.shape[0]
    for row in range(camera.height):
        y = (row + steps - camera.cy) / camera.fy
        rays = np.stack(np.broadcast_arrays(x, y[:, None], 1.0), axis=-1)
        normal, origin = T_camera_label[:3, 2], T_camera_label[:3, 3]
        distance = (normal @ origin) / (rays @ normal)
        in_label = (rays * distance[..., None] - origin) @ T_camera_label[:3, :3]
        cells = np.floor(in_label[..., :2] / (SIZE_MM / count) + count / 2).astype(int)
        inside = np.all((cells >= 0) & (cells < count), axis=-1)
        across, down = np.clip(np.moveaxis(cells, -1, 0), 0, count - 1)
        light = np.where(inside & modules[down, across], 0.01, 0.72)
        mean = light.reshape(fineness, camera.width, fineness).mean(axis=(0, 2))
        image[row] = np.round(255 * mean ** (1 / 2.2))
    return image
