from __future__ import annotations

import asyncio

import cv2
import numpy as np
import pytest
import zxingcpp

from drivers.camera import Frame, pi_camera_v2
from drivers.simulator.parameters import SimulationParameters
from drivers.simulator.view import CameraView
from tests.drivers.simulator.stand import GEOMETRY, HOMED, PERFECT, Stand, on_stand
from twin.camera_mount import CameraMount
from twin.joints import JointPosition
from twin.kinematics import gamma

AWAY = JointPosition(300.0, 60.0, 60.0)


def test_the_picture_agrees_with_an_independent_projection() -> None:
    """By hand: platform from the circle equations, camera turned by half a turn about z."""

    async def scenario(stand: Stand) -> tuple[CameraView, np.ndarray]:
        await stand.move(AWAY)
        return stand.world.view_at(stand.now_s), stand.world.car.T_base_label

    view, label = on_stand(scenario)
    # legs of 532 mm from (-25 + 300, 0) and (1300 - 60 + 25, 0) to V -/+ (80, 0)
    left, right = -25.0 + 300.0 + 80.0, 1325.0 - 60.0 - 80.0
    v = np.array([(left + right) / 2, np.sqrt(532.0**2 - ((right - left) / 2) ** 2), 0.0])
    camera = v + np.array([120.0, -15.0, -50.0])
    corners = np.array([[-30, -30, 0], [30, -30, 0], [30, 30, 0], [-30, 30, 0]], dtype=float)
    in_base = corners @ label[:3, :3].T + label[:3, 3]
    seen = (in_base - camera) * (-1.0, -1.0, 1.0)  # x and y turned round
    optics = pi_camera_v2()
    expected, _ = cv2.projectPoints(
        seen, np.zeros(3), np.zeros(3), optics.matrix, optics.distortion
    )
    pose = view.T_camera_label
    rotation, _ = cv2.Rodrigues(pose[:3, :3])
    pixels, _ = cv2.projectPoints(corners, rotation, pose[:3, 3], optics.matrix, optics.distortion)
    # a micro-step of both carriages is 0.05 px here
    assert pixels == pytest.approx(expected, abs=0.06)


def test_before_the_socket_the_label_is_in_the_middle_of_the_picture() -> None:
    async def scenario(stand: Stand) -> CameraView:
        await stand.align()
        return stand.world.view_at(stand.now_s)

    view = on_stand(scenario)
    x, y, z = view.T_camera_label[:3, 3]
    assert abs(x) < 1.0
    assert abs(y) < 40.0
    assert 270.0 < z < 310.0
    socket = view.T_camera_socket[:3, 3] - view.T_camera_label[:3, 3]
    assert socket == pytest.approx((120.0, 0.0, 0.0), abs=1e-9)
    plug = np.linalg.inv(view.T_camera_plug) @ view.T_camera_socket
    assert plug[:3, 3] == pytest.approx((0.0, 0.0, 8.0), abs=0.1)
    assert view.payload == "demo"
    assert view.label_size_mm == 60.0


@pytest.mark.parametrize("parameters", [PERFECT, HOMED], ids=["perfect", "real"])
def test_the_label_velocity_is_the_derivative_of_its_pose(
    parameters: SimulationParameters,
) -> None:
    async def scenario(stand: Stand) -> None:
        moving = asyncio.create_task(stand.move(AWAY))
        fastest = 0.0
        while not moving.done():
            await asyncio.sleep(0.037)
            t_s = stand.now_s - 0.06
            before, now, after = (stand.world.view_at(t_s + d) for d in (-0.02, 0.0, 0.02))
            way = after.T_camera_label[:3, 3] - before.T_camera_label[:3, 3]
            # steps of 0.0044 mm over 0.04 s, and the sag that the velocity leaves out
            assert now.label_velocity_mm_s == pytest.approx(way / 0.04, abs=0.9)
            fastest = max(fastest, float(np.linalg.norm(way)) / 0.04)
        await moving
        assert fastest > 40.0

    on_stand(scenario, parameters)


def test_the_past_looks_as_it_did() -> None:
    async def scenario(stand: Stand) -> None:
        moving = asyncio.create_task(stand.move(AWAY))
        seen: list[tuple[float, CameraView]] = []
        while not moving.done():
            seen.append((stand.now_s, stand.world.view_at(stand.now_s)))
            await asyncio.sleep(0.013)
            if len(seen) > 9:
                t_s, view = seen[-9]
                again = stand.world.view_at(t_s).T_camera_label
                assert again == pytest.approx(view.T_camera_label, abs=1e-6)
        await moving

    on_stand(scenario, HOMED)


def test_the_near_future_is_what_happens_then() -> None:
    async def scenario(stand: Stand) -> None:
        segments = await stand.segments_to(AWAY)
        await stand.robot.push(segments[:16])
        await asyncio.sleep(0.05)
        foreseen = stand.world.view_at(stand.now_s + 0.03)
        await asyncio.sleep(0.03)
        now = stand.world.view_at(stand.now_s)
        assert now.T_camera_label == pytest.approx(foreseen.T_camera_label, abs=1e-6)

    on_stand(scenario, HOMED)


def test_a_covered_label_is_out_of_sight_and_comes_back() -> None:
    async def scenario(stand: Stand) -> None:
        before = stand.world.view_at(stand.now_s)
        stand.world.hide_label()
        covered = stand.world.view_at(stand.now_s)
        assert covered.T_camera_label[2, 3] > 10_000.0
        assert np.array_equal(covered.T_camera_socket, before.T_camera_socket)
        stand.world.show_label()
        again = stand.world.view_at(stand.now_s)
        assert np.array_equal(again.T_camera_label, before.T_camera_label)

    on_stand(scenario)


def test_the_pictures_show_a_decodable_label_and_none_when_it_is_covered() -> None:
    def read(frame: Frame) -> list[str]:
        return [barcode.text for barcode in zxingcpp.read_barcodes(frame.image)]

    async def scenario(stand: Stand) -> tuple[list[str], list[str]]:
        camera = stand.garage.camera
        await camera.open()
        await stand.align()
        shown = await camera.frame(exposed_after_s=stand.now_s)
        stand.world.hide_label()
        hidden = await camera.frame(exposed_after_s=stand.now_s)
        await camera.close()
        return read(shown), read(hidden)

    shown, hidden = on_stand(scenario, HOMED)
    assert shown == ["demo"]
    assert hidden == []


def test_the_tip_in_the_picture_is_where_the_true_kinematics_put_it() -> None:
    async def scenario(stand: Stand) -> tuple[CameraView, JointPosition]:
        await stand.move(AWAY)
        return stand.world.view_at(stand.now_s), (await stand.state()).measured.position

    view, joints = on_stand(scenario)
    v = gamma.platform(GEOMETRY, joints)
    tip = np.array(gamma.forward(GEOMETRY, joints))
    mount = CameraMount()
    offset = tip - (v.x_mm + mount.x_mm, v.y_mm + mount.y_mm, mount.z_mm)
    assert view.T_camera_plug[:3, 3] == pytest.approx(offset * (-1, -1, 1), abs=0.02)
