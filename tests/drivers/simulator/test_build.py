from __future__ import annotations

import numpy as np
import pytest

from drivers.camera import pi_camera_v2
from drivers.simulator.build import built_geometry, built_mount, built_optics
from drivers.simulator.parameters import BuildErrors, SimulationParameters
from tests.drivers.simulator.stand import GEOMETRY
from twin.camera_mount import CameraMount

ERRORS = BuildErrors()


def test_lengths_and_angle_scatter_around_the_drawing() -> None:
    built = [built_geometry(GEOMETRY, ERRORS, np.random.default_rng(seed)) for seed in range(300)]
    for name in ("leg_length_mm", "base_width_mm", "platform_width_mm", "e1x_mm", "e2y_mm"):
        errors = np.array([getattr(g, name) - getattr(GEOMETRY, name) for g in built])
        assert errors.std() == pytest.approx(ERRORS.length_std_mm, rel=0.15)
        assert abs(errors.mean()) < 0.2 * ERRORS.length_std_mm
    theta = np.array([g.theta_rad - GEOMETRY.theta_rad for g in built])
    assert theta.std() == pytest.approx(ERRORS.theta_std_rad, rel=0.15)


def test_what_is_no_dimension_of_the_machine_stays() -> None:
    built = built_geometry(GEOMETRY, ERRORS, np.random.default_rng(1))
    assert built.rho1 == GEOMETRY.rho1
    assert built.regular_box == GEOMETRY.regular_box


def test_the_camera_sits_a_little_crooked() -> None:
    mount = CameraMount()
    offsets, angles = [], []
    for seed in range(300):
        built = built_mount(mount, ERRORS, np.random.default_rng(seed))
        difference = np.linalg.inv(mount.T_platform_camera) @ built
        rotation = difference[:3, :3]
        assert rotation @ rotation.T == pytest.approx(np.eye(3), abs=1e-12)
        offsets.append(difference[:3, 3])
        angles.append((rotation[2, 1], rotation[0, 2], rotation[1, 0]))
    assert np.std(offsets) == pytest.approx(ERRORS.mount_offset_std_mm, rel=0.1)
    assert np.std(angles) == pytest.approx(ERRORS.mount_angle_std_rad, rel=0.1)


def test_the_optics_differ_from_the_data_sheet() -> None:
    nominal = pi_camera_v2()
    built = [built_optics(nominal, ERRORS, np.random.default_rng(s)) for s in range(300)]
    assert np.std([o.cx - nominal.cx for o in built]) == pytest.approx(
        ERRORS.principal_point_std_px, rel=0.15
    )
    assert np.std([o.fx / nominal.fx for o in built]) == pytest.approx(
        ERRORS.focal_std_fraction, rel=0.15
    )
    assert all(o.fx / o.fy == pytest.approx(nominal.fx / nominal.fy) for o in built)


def test_a_perfect_machine_is_built_as_drawn() -> None:
    errors = SimulationParameters.perfect().build
    rng = np.random.default_rng(1)
    assert built_geometry(GEOMETRY, errors, rng) == GEOMETRY
    mount = CameraMount()
    assert built_mount(mount, errors, rng) == pytest.approx(mount.T_platform_camera, abs=1e-15)
    assert built_optics(pi_camera_v2(), errors, rng) == pi_camera_v2()
