"""Places from which the label would not be seen are not gone to."""

from __future__ import annotations

import numpy as np

from server.calibration.routines.places import (
    behind_the_plug,
    half_of_label_mm,
    label_is_seen,
    reachable_places,
)
from server.config.settings import Settings
from twin.kinematics import alpha, gamma

SETTINGS = Settings()
GEOMETRY, MOUNT = SETTINGS.geometry, SETTINGS.camera.mount
MIDDLE = np.array([GEOMETRY.regular_box.center_x_mm, GEOMETRY.regular_box.center_y_mm])
HIDDEN = behind_the_plug(GEOMETRY, MOUNT, MOUNT.T_platform_camera[:3, :3], margin_mm=8.0)


def in_camera(beside_platform_mm: tuple[float, float, float]) -> np.ndarray:
    from_lens = np.array(beside_platform_mm) - MOUNT.T_platform_camera[:3, 3]
    return from_lens[None] @ MOUNT.T_platform_camera[:3, :3]


def test_what_lies_beyond_the_plug_is_hidden_and_what_lies_before_it_is_not() -> None:
    dy_mm, z_mm = gamma.tip_offset(GEOMETRY, GEOMETRY.rho3.min_mm)
    lens = MOUNT.T_platform_camera[:3, 3]
    tip = np.array([0.0, dy_mm, z_mm])
    beyond, before = (lens + share * (tip - lens) for share in (1.2, 0.5))
    assert HIDDEN(in_camera(tuple(beyond.tolist())))[0]
    assert not HIDDEN(in_camera(tuple(before.tolist())))[0]
    away = beyond - np.sign(tip[0] - lens[0]) * np.array([90.0, 0.0, 0.0])
    assert not HIDDEN(in_camera(tuple(away.tolist())))[0]


def test_the_whole_label_must_be_in_the_picture_and_keep_its_margin() -> None:
    optics = SETTINGS.camera.optics
    half_mm = half_of_label_mm(60.0, 0.0)
    mm_per_px = 290.0 / optics.fx
    edge_mm = (optics.cx - 12.0) * mm_per_px  # where a point keeps twelve pixels
    label = np.array([[-edge_mm + half_mm + beyond_mm, 0.0, 290.0] for beyond_mm in (3.0, -3.0)])

    def nothing(points: np.ndarray) -> np.ndarray:
        return np.zeros(len(points), dtype=bool)

    def everything(points: np.ndarray) -> np.ndarray:
        return np.ones(len(points), dtype=bool)

    seen = [
        label_is_seen(label, half_mm=half_mm, optics=optics, edge_px=edge_px, hidden=hidden)
        for edge_px, hidden in ((12.0, nothing), (40.0, nothing), (12.0, everything))
    ]
    np.testing.assert_array_equal(seen, [[True, False], [False, False], [False, False]])


def test_a_label_that_hangs_askew_takes_more_room() -> None:
    assert half_of_label_mm(60.0, np.radians(45.0)) > 1.4 * half_of_label_mm(60.0, 0.0)


def test_carriages_keep_away_from_the_ends_of_their_rails() -> None:
    rho = reachable_places(GEOMETRY, MIDDLE)
    assert rho.min() > GEOMETRY.rho1.min_mm
    assert rho[:, 0].max() < GEOMETRY.rho1.max_mm
    reached = alpha.forward_many(GEOMETRY, rho)
    assert np.ptp(reached, axis=0).min() > 200.0
