"""The renderer against brute force and against what optics says."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from drivers.camera import CameraModel, pi_camera_v2
from drivers.simulator.camera.imaging import ImagingParameters
from drivers.simulator.camera.renderer import Renderer
from drivers.simulator.camera.scene import SceneRenderer
from server.vision.projection import undistort
from tests.drivers.simulator.camera.scenes import PAYLOAD, SIZE_MM, pose, view
from twin.qr_label import label_modules

OPTICS = CameraModel(
    width=300, height=260, fx=420.0, fy=425.0, cx=151.3, cy=127.8,
    k1=-0.12, k2=0.05, p1=1e-3, p2=-5e-4,
)  # fmt: skip
IN_FOCUS = ImagingParameters(focus_distance_mm=250.0, lens_blur_px=0.9, readout_s=0.0)


def brute_force(label: NDArray[np.float64], fineness: int) -> NDArray[np.float64]:
    """Reflectance of label and surroundings (0.5) by many rays per pixel, then the lens blur."""
    steps = (np.arange(fineness) + 0.5) / fineness - 0.5
    modules = np.pad(label_modules(PAYLOAD), 4)
    count = len(modules)
    module_mm = SIZE_MM / (count - 8)
    image = np.empty((OPTICS.height, OPTICS.width))
    u = (np.arange(OPTICS.width)[:, None] + steps).ravel()
    for row in range(OPTICS.height):
        pixels = np.stack(np.broadcast_arrays(u, (row + steps)[:, None]), axis=-1)
        rays = undistort(OPTICS, pixels.reshape(-1, 2)).reshape(fineness, -1, 2)
        rays = np.concatenate((rays, np.ones((*rays.shape[:2], 1))), axis=-1)
        normal, origin = label[:3, 2], label[:3, 3]
        distance = (normal @ origin) / (rays @ normal)
        in_label = (rays * distance[..., None] - origin) @ label[:3, :3]
        cells = np.floor(in_label[..., :2] / module_mm + count / 2).astype(int)
        inside = np.all((cells >= 0) & (cells < count), axis=-1)
        x, y = np.clip(np.moveaxis(cells, -1, 0), 0, count - 1)
        light = np.where(inside, np.where(modules[y, x], 0.05, 0.85), 0.5)
        image[row] = light.reshape(fineness, OPTICS.width, fineness).mean(axis=(0, 2))
    # The pixel's own aperture has the variance 1/12 px^2; the rest of 0.9 px is the lens.
    blurred = cv2.GaussianBlur(image, (0, 0), float(np.sqrt(0.9**2 - 1 / 12)))
    return np.asarray(blurred, dtype=np.float64)


@pytest.mark.parametrize(
    "label",
    [pose(3.0, -2.0, 250.0, (0.0, 0.0, 3.1)), pose(-6.0, 5.0, 230.0, (0.3, -0.25, 0.4))],
    ids=["head-on", "oblique"],
)
def test_a_label_looks_as_brute_force_says(label: NDArray[np.float64]) -> None:
    canvas = SceneRenderer(OPTICS, IN_FOCUS).render(view(label)).canvas
    expected = brute_force(label, fineness=6)
    corners = np.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0.0)]) * SIZE_MM * 0.55
    turn = cv2.Rodrigues(label[:3, :3])[0]
    pixels, _ = cv2.projectPoints(corners, turn, label[:3, 3], OPTICS.matrix, OPTICS.distortion)
    inside = np.zeros(canvas.shape, dtype=np.uint8)
    cv2.fillConvexPoly(inside, np.asarray(pixels).round().astype(np.int32), (1,))
    difference = (canvas - expected)[inside > 0]
    assert np.sqrt(np.mean(difference**2)) < 0.012
    assert np.abs(difference).max() < 0.07
    # A picture shifted by a tenth of a pixel to any side would fit worse.
    for axis in (0, 1):
        slope = np.gradient(expected, axis=axis)[inside > 0]
        shift_px = float(slope @ difference / (slope @ slope))
        assert abs(shift_px) < 0.002


def test_motion_smears_the_label_along_its_way_only() -> None:
    label = pose(0.0, 0.0, 250.0, (0.0, 0.0, 0.0))
    scene = SceneRenderer(OPTICS, IN_FOCUS)
    still = scene.render(view(label)).canvas.copy()
    moving = scene.render(view(label, velocity_mm_s=(400.0, 0.0, 0.0))).canvas.copy()
    code = (slice(80, 176), slice(104, 200))

    def steepness(canvas: NDArray[np.float32], axis: int) -> float:
        return float(np.abs(np.diff(canvas[code], axis=axis)).mean())

    assert steepness(moving, 1) < 0.75 * steepness(still, 1)
    assert steepness(moving, 0) > 0.9 * steepness(still, 0)
    assert moving[code].mean() == pytest.approx(still[code].mean(), abs=0.01)


def test_the_plug_hides_the_label_behind_it() -> None:
    label = pose(0.0, 0.0, 300.0, (0.0, 0.0, 0.0))
    scene = SceneRenderer(OPTICS, IN_FOCUS)
    plug = pose(0.0, 0.0, 200.0, (0.0, 0.0, 0.0))
    free = scene.render(view(label)).canvas.copy()
    hidden = scene.render(view(label, plug=plug, socket_mm=(0.0, 0.0, 0.0))).canvas.copy()
    assert free[118:138, 141:161].max() > 0.5
    assert hidden[118:138, 141:161].max() < 0.1


def test_an_inserted_plug_shows_no_further_than_the_face_of_the_socket() -> None:
    """Its outline is that of a plug that only touches the face."""
    label = pose(-60.0, 0.0, 300.0, (0.0, 0.0, 0.0))
    scene = SceneRenderer(OPTICS, IN_FOCUS)
    touching = scene.render(
        view(label, plug=pose(60.0, 15.0, 300.0, (0.0, 0.0, 0.0)))
    ).canvas.copy()
    inserted = scene.render(
        view(label, plug=pose(60.0, 15.0, 340.0, (0.0, 0.0, 0.0)))
    ).canvas.copy()
    np.testing.assert_allclose(inserted, touching, atol=0.05)


def test_a_car_that_has_left_leaves_an_empty_garage() -> None:
    gone = view(pose(0.0, 0.0, 50_000.0, (0.0, 0.0, 0.0)))
    canvas = SceneRenderer(OPTICS, IN_FOCUS).render(gone).canvas
    assert float(np.ptp(canvas)) < 1e-6


def test_a_label_partly_out_of_the_picture_is_cut_off() -> None:
    label = pose(85.0, -60.0, 250.0, (0.0, 0.0, 0.0))
    beside = view(label, socket_mm=(-300.0, 0.0, 0.0))
    whole = SceneRenderer(OPTICS, IN_FOCUS).render(beside).canvas
    assert whole[0:60, 260:].max() > 0.8
    assert whole[200:, :40].max() < 0.6


def test_noise_is_that_of_light_and_sensor() -> None:
    imaging = IN_FOCUS.model_copy(
        update={"gamma": 1.0, "vignetting": 0.0, "illumination_gradient": 0.0}
    )
    renderer = Renderer(OPTICS, imaging, seed=4)
    scene = view(pose(0.0, 0.0, 250.0, (0.0, 0.0, 0.0)))
    pictures = np.array([renderer.picture(scene, n) for n in range(40)], dtype=np.float64)
    white = pictures[:, 128 - 62 : 128 - 54, 110:190]
    level = white.mean()
    # 0.25 of 10000 electrons on white, 6 electrons of read noise; 1/12 for whole grey values.
    electrons = 2500.0
    expected = level / electrons * np.sqrt(electrons + 36.0)
    measured = np.sqrt(np.var(white, axis=0).mean() - 1 / 12)
    assert measured == pytest.approx(expected, rel=0.06)


def test_the_gain_is_set_for_the_usual_light_up_to_its_limit() -> None:
    scene = view(pose(0.0, 0.0, 250.0))
    brightness = {}
    for ambient in (1.0, 0.4, 0.02):
        imaging = IN_FOCUS.model_copy(update={"ambient": ambient})
        brightness[ambient] = np.percentile(Renderer(OPTICS, imaging, 1).picture(scene, 0), 98)
    assert brightness[0.4] == pytest.approx(brightness[1.0], abs=6)
    assert brightness[0.02] < brightness[1.0] - 60


def test_a_fixed_exposure_does_not_follow_the_light() -> None:
    renderer, scene = Renderer(OPTICS, IN_FOCUS, 1), view(pose(0.0, 0.0, 250.0))
    usual, half = renderer.picture(scene, 0), renderer.picture(scene, 0, light=0.5)
    white = (slice(68, 74), slice(110, 190))
    expected = usual[white].mean() * 0.5 ** (1 / IN_FOCUS.gamma)
    assert half[white].mean() == pytest.approx(expected, rel=0.01)


def test_edges_of_the_picture_are_darker_than_its_middle() -> None:
    optics = pi_camera_v2()
    gone = view(pose(0.0, 0.0, 50_000.0, (0.0, 0.0, 0.0)))
    image = Renderer(optics, ImagingParameters(), 1).picture(gone, 0).astype(np.float64)
    corners = [image[:40, :40], image[:40, -40:], image[-40:, :40], image[-40:, -40:]]
    assert max(corner.mean() for corner in corners) < image[596:636, 800:840].mean() - 10
