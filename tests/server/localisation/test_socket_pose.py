from __future__ import annotations

import asyncio
import math

import numpy as np
import pytest

from drivers.simulator.parameters import SimulationParameters
from server.localisation.frames import base_from_camera, inverse, label_from_socket
from server.localisation.socket_pose import SocketPose, socket_from_label
from server.schema.vehicles import SocketOffset
from server.vision import LabelPose
from server.vision.projection import perturbed
from tests.support.robot_cell import AWAY, GEOMETRY, HOME, RobotCell, in_cell, parameters
from twin.camera_mount import CameraMount
from twin.joints import JointPosition

OFFSET = SocketOffset(x_mm=120.0, y_mm=-7.0, z_mm=4.0, rotation_x_rad=0.02, rotation_y_rad=-0.03)


def sighting(T_camera_label: np.ndarray, covariance: np.ndarray) -> LabelPose:
    return LabelPose(
        payload="PLUGPILOT:1:demo",
        T_camera_label=T_camera_label,
        covariance=covariance,
        rms_px=0.1,
        inlier_share=1.0,
        edge_count=100,
        spread_px=0.0,
    )


def tilted_label() -> np.ndarray:
    pose = np.eye(4)
    pose[:3, 3] = 10.0, -20.0, 300.0
    return perturbed(pose, np.array([0.05, -0.04, 0.03, 0.0, 0.0, 0.0]))


def a_covariance() -> np.ndarray:
    rng = np.random.default_rng(3)
    root = rng.normal(size=(6, 6)) * [[1e-3], [2e-3], [5e-4], [0.01], [0.02], [0.1]]
    return np.asarray(root @ root.T)


def test_the_covariance_is_what_a_monte_carlo_run_scatters() -> None:
    T_base_camera = base_from_camera(GEOMETRY, CameraMount(rotation_x_rad=0.3), HOME)
    truth, covariance = tilted_label(), a_covariance()
    found = socket_from_label(sighting(truth, covariance), T_base_camera, OFFSET, 0.0)
    rng = np.random.default_rng(1)
    deltas = rng.multivariate_normal(np.zeros(6), covariance, size=20_000)
    origins = np.array(
        [
            socket_from_label(
                sighting(perturbed(truth, delta), covariance), T_base_camera, OFFSET, 0.0
            ).entry
            for delta in deltas
        ]
    )
    scatter = np.cov(origins.T)
    scale = np.sqrt(np.outer(np.diag(scatter), np.diag(scatter)))
    assert (found.covariance - scatter) / scale == pytest.approx(np.zeros((3, 3)), abs=0.03)
    along = (origins - np.array(found.entry)) @ found.axis
    assert found.depth_sigma_mm == pytest.approx(along.std(), rel=0.03)
    across = (origins - np.array(found.entry)) - np.outer(along, found.axis)
    largest = math.sqrt(np.linalg.eigvalsh(np.cov(across.T))[-1])
    assert found.lateral_sigma_mm == pytest.approx(largest, rel=0.03)


def test_a_wrong_tilt_counts_with_its_lever() -> None:
    """One milliradian about the camera's y at 120 mm beside the label is 0.12 mm in depth."""
    covariance = np.zeros((6, 6))
    covariance[1, 1] = 1e-6
    label = np.eye(4)
    label[2, 3] = 300.0
    straight = SocketOffset(x_mm=120.0, y_mm=0.0, z_mm=0.0, rotation_x_rad=0.0, rotation_y_rad=0.0)
    found = socket_from_label(sighting(label, covariance), np.eye(4), straight, 0.0)
    assert found.depth_sigma_mm == pytest.approx(0.12)
    assert found.lateral_sigma_mm == pytest.approx(0.0, abs=1e-9)


def test_tilt_is_the_angle_to_the_insertion_axis() -> None:
    c, s = math.cos(GEOMETRY.theta_rad + 0.03), math.sin(GEOMETRY.theta_rad + 0.03)
    pose = np.eye(4)
    pose[:3, 2] = 0.0, s, c
    socket = SocketPose(pose, np.eye(4), np.zeros((3, 3)), 0.0)
    assert socket.tilt_rad(GEOMETRY) == pytest.approx(0.03)


def test_the_socket_lies_where_its_offset_says_in_the_label_frame() -> None:
    pose = label_from_socket(OFFSET)
    assert pose[:3, 3] == pytest.approx((120.0, -7.0, 4.0))
    assert pose[:3, :3] @ pose[:3, :3].T == pytest.approx(np.eye(3))
    assert np.linalg.det(pose) == pytest.approx(1.0)
    # about x first: the label's z goes to (0, -sin, cos); then about y
    z = pose[:3, 2]
    assert z == pytest.approx(
        (math.cos(0.02) * math.sin(-0.03), -math.sin(0.02), math.cos(0.02) * math.cos(-0.03))
    )
    assert inverse(pose) @ pose == pytest.approx(np.eye(4))


@pytest.mark.parametrize("joints", [HOME, AWAY, JointPosition(60.0, 300.0, 55.0)])
def test_frames_agree_with_the_simulated_truth(joints: JointPosition) -> None:
    """In a perfect garage the true view and the robot's own chain lead to the same socket."""

    async def scenario(cell: RobotCell) -> None:
        async with cell.supervisor.control("job", "Test") as lease:
            await cell.supervisor.move_joints(lease, joints)
        await asyncio.sleep(0.5)
        world = cell.garage.world
        view = world.view_at(asyncio.get_running_loop().time())
        T_base_camera = base_from_camera(GEOMETRY, CameraMount(), cell.robot.measured.position)
        assert T_base_camera @ view.T_camera_label == pytest.approx(
            world.car.T_base_label, abs=1e-3
        )
        known = world.car.known_offset
        offset = SocketOffset(
            x_mm=known.x_mm,
            y_mm=known.y_mm,
            z_mm=known.z_mm,
            rotation_x_rad=known.rotation_x_rad,
            rotation_y_rad=known.rotation_y_rad,
        )
        found = socket_from_label(
            sighting(view.T_camera_label, np.eye(6)), T_base_camera, offset, 1.5
        )
        assert found.T_base_socket == pytest.approx(world.car.T_base_socket, abs=1e-3)
        assert found.measured_at_s == 1.5

    in_cell(scenario, _crooked_car())


def _crooked_car() -> SimulationParameters:
    """A perfect robot before a car that is parked askew with a label that is stuck askew."""
    numbers = parameters()
    crooked = numbers.car.model_copy(
        update={"tilt_std_rad": 0.02, "sticking_std_mm": 0.5, "sticking_angle_std_rad": 0.01}
    )
    return numbers.model_copy(update={"car": crooked})
