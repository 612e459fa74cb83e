"""Rolling shutter against what the time of each row says."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from drivers.camera import CameraModel
from drivers.simulator.camera.imaging import ImagingParameters
from drivers.simulator.camera.row_motion import RowMotion, view_while_read_out
from drivers.simulator.camera.scene import SceneRenderer
from drivers.simulator.view import CameraView
from tests.drivers.simulator.camera.scenes import pose, view

OPTICS = CameraModel(width=640, height=480, fx=1200.0, fy=1200.0, cx=319.5, cy=239.5)
ROLLING = ImagingParameters(readout_s=0.02, exposure_s=1e-5)
DISTANCE_MM = 300.0


def left_edge_px(canvas: np.ndarray, row: int) -> float:
    """Where the label's white begins in a row, to a fraction of a pixel."""
    line = canvas[row].astype(np.float64)
    first = int(np.argmax(line > 0.6))
    slope = np.diff(line[first - 5 : first + 5])
    return first - 5 + float((slope * np.arange(9)).sum() / slope.sum())


def far_socket(label: np.ndarray, velocity: tuple[float, float, float]) -> CameraView:
    return view(label, velocity_mm_s=velocity, socket_mm=(5000.0, 0.0, 0.0))


def test_the_skew_is_the_way_during_the_read_out() -> None:
    label, speed = pose(0.0, 0.0, DISTANCE_MM), 150.0
    scene = SceneRenderer(OPTICS, ROLLING)
    rolling = scene.render(far_socket(label, (speed, 0.0, 0.0))).canvas.copy()
    still = scene.render(far_socket(label, (0.0, 0.0, 0.0))).canvas.copy()
    for row in (100, 180, 239, 300, 380):
        seen_s = (row / 479 - 0.5) * 0.02
        expected = speed * seen_s * OPTICS.fx / DISTANCE_MM
        moved = left_edge_px(rolling, row) - left_edge_px(still, row)
        assert moved == pytest.approx(expected, abs=0.05)


def test_a_label_that_moves_down_with_the_rows_is_stretched() -> None:
    label = pose(0.0, 0.0, DISTANCE_MM)
    scene = SceneRenderer(OPTICS, ROLLING)
    moving = scene.render(far_socket(label, (0.0, 200.0, 0.0))).canvas.copy()
    still = scene.render(far_socket(label, (0.0, 0.0, 0.0))).canvas.copy()

    def height_px(canvas: np.ndarray) -> int:
        return int(np.sum(canvas[:, 190] > 0.6))

    # it runs ahead of the rows at 800 of their 24000 px/s
    assert height_px(moving) / height_px(still) == pytest.approx(1 / (1 - 800 / 24000), abs=0.01)


def test_rows_follow_the_true_way_even_when_it_is_curved() -> None:
    def at(t_s: float) -> CameraView:
        return view(pose(30.0 * t_s + 900.0 * t_s**2, 0.0, DISTANCE_MM))

    seen = view_while_read_out(at, 1.0, 0.02)
    assert seen.T_camera_label == pytest.approx(at(1.0).T_camera_label)
    rows = RowMotion(seen, 0.02, OPTICS.height)
    for row in (0, 111, 400, 479):
        t_s = 1.0 + (row / 479 - 0.5) * 0.02
        true_mm = at(t_s).T_camera_label[0, 3] - at(1.0).T_camera_label[0, 3]
        assert rows.offsets_mm(np.array([float(row)]))[0, 0] == pytest.approx(true_mm, abs=1e-9)


def test_correcting_a_row_is_the_same_as_moving_the_plane() -> None:
    rng = np.random.default_rng(3)
    plane = pose(12.0, -7.0, 280.0, (0.2, -0.3, 0.4))
    seen = replace(view(plane), label_velocity_mm_s=np.array([90.0, -60.0, 40.0]))
    rows = RowMotion(seen, 0.02, OPTICS.height)
    rays = np.column_stack((rng.uniform(-0.2, 0.2, (8, 2)), np.ones(8)))
    places = np.linspace(0, 479, 8)

    def hit(pose_of_plane: np.ndarray, ray: np.ndarray) -> np.ndarray:
        on_plane = np.linalg.solve(pose_of_plane[:3, (0, 1, 3)], ray)
        return np.asarray(on_plane[:2] / on_plane[2])

    first = np.array([hit(plane, ray) for ray in rays], dtype=np.float32)
    x, y = first[:, :1].copy(), first[:, 1:].copy()
    rows.correct(x, y, places, plane)
    for index, ray in enumerate(rays):
        moved = plane.copy()
        moved[:3, 3] += rows.offsets_mm(places[index : index + 1])[0]
        assert (x[index, 0], y[index, 0]) == pytest.approx(hit(moved, ray), abs=2e-3)


def test_nothing_is_skewed_at_rest() -> None:
    assert RowMotion(view(pose(0.0, 0.0, 300.0)), 0.02, 480).still
