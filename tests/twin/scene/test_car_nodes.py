"""The car in the picture."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from viser.transforms import SO3

from twin.geometry import RobotGeometry
from twin.scene import car, layers, plug_parts, poses
from twin.scene.frames import pose, rotation_x
from twin.scene.materials import CHARGING, IDLE, PLUGGED
from twin.scene.scene import TwinScene
from twin.scene.state import TwinState


def test_a_car_that_was_not_seen_is_pale_and_in_the_middle(
    scene: TwinScene, geometry: RobotGeometry
) -> None:
    assert scene.car.faded.visible
    assert not scene.car.body.visible
    assert not scene.car.wheels.visible
    center = np.array(poses.region_center(geometry)) / 1000
    assert scene.car.car.position == pytest.approx(center)


def test_a_measured_car_stands_where_it_was_measured(
    scene: TwinScene, geometry: RobotGeometry
) -> None:
    socket = pose(rotation_x(-geometry.theta_rad), (610.0, 350.0, 240.0))
    label = pose(np.diag([-1.0, -1.0, 1.0]), (731.0, 352.0, 243.0))
    scene.show(TwinState(T_base_socket=socket, T_base_label=label))
    assert scene.car.body.visible
    assert not scene.car.faded.visible
    assert scene.car.car.position == pytest.approx([0.61, 0.35, 0.24])
    turned = SO3(np.asarray(scene.car.car.wxyz)).as_matrix()
    assert turned == pytest.approx(socket[:3, :3], abs=1e-9)
    assert scene.car.label.position == pytest.approx([0.731, 0.352, 0.243])
    assert SO3(np.asarray(scene.car.label.wxyz)).as_matrix() == pytest.approx(
        label[:3, :3], abs=1e-9
    )
    # The wheels stay on the floor however high the socket is.
    assert scene.car.wheels.position == pytest.approx([0.61, layers.FLOOR_Y / 1000, 0.24])


def test_a_car_that_is_gone_is_pale_again(scene: TwinScene, geometry: RobotGeometry) -> None:
    scene.show(TwinState(T_base_socket=poses.nominal_socket(geometry)))
    scene.show(TwinState())
    assert scene.car.faded.visible
    assert not scene.car.body.visible


def test_the_ring_tells_plugged_and_charging(scene: TwinScene) -> None:
    assert tuple(scene.car.ring.color) == IDLE
    scene.show(TwinState(plug="inserted"))
    assert tuple(scene.car.ring.color) == PLUGGED
    scene.show(TwinState(plug="inserted", charging=True))
    assert tuple(scene.car.ring.color) == CHARGING


@pytest.mark.parametrize("theta_rad", [-0.17, 0.0, 0.1])
def test_nothing_of_the_car_stands_in_the_plugs_way(theta_rad: float) -> None:
    radius = plug_parts.PLUG_RADIUS + 2
    for mesh, material in [*car.body(theta_rad), *car.inlet()]:
        corners = mesh.vertices_mm[mesh.faces]
        # Points all over each triangle, in the frame of the socket.
        weights = np.random.default_rng(1).dirichlet((1, 1, 1), 12)
        points = np.einsum("wk,fkd->fwd", weights, corners).reshape(-1, 3)
        in_the_way = points[np.hypot(points[:, 0], points[:, 1]) < radius]
        assert (in_the_way[:, 2] > 25).all(), material.name


def test_the_label_is_a_code_that_a_camera_reads() -> None:
    (picture,) = (m.texture_png for _, m in car.label() if m.texture_png is not None)
    image = cv2.imdecode(np.frombuffer(picture, np.uint8), cv2.IMREAD_GRAYSCALE)
    assert image is not None
    text, _, _ = cv2.QRCodeDetector().detectAndDecode(cv2.resize(image, None, fx=2, fy=2))
    assert text == "PLUGPILOT"


@pytest.mark.parametrize("theta_rad", [-0.3, -0.17, 0.0, 0.1])
def test_the_opaque_front_ends_before_the_body_begins_to_fade(theta_rad: float) -> None:
    front, rear = car._nose(theta_rad)
    assert rear.alpha is not None
    corners = front.vertices_mm[front.faces]
    assert rear.alpha[front.faces].min() == 1.0, corners[..., 2].max()
    assert rear.alpha[rear.faces].min() < 0.05
