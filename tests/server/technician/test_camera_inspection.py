"""The camera as a technician sees it: what is drawn over the picture lies where the label is."""

from __future__ import annotations

import cv2
import httpx
import numpy as np
import pytest
import zxingcpp

from drivers.simulator.camera.imaging import CameraFault
from server.localisation.frames import base_from_camera
from server.technician.camera_inspection import KEPT
from server.technician.seen_label import POINTS_PER_SIDE, ellipse_of
from server.technician.tools import INSPECTION_PATIENCE_S
from tests.support.api import on_api, problem
from tests.support.garage import Scene

NEAR_PX = 3.0
"""The reader of codes is good to a pixel or two of its smaller picture."""


def _picture(jpeg: bytes) -> np.ndarray:
    image = cv2.imdecode(np.frombuffer(jpeg, np.uint8), cv2.IMREAD_GRAYSCALE)
    assert image is not None
    return image


def test_the_outline_lies_on_the_label_and_the_pose_is_true() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        found = (await client.get("camera/inspection")).json()
        jpeg = (await client.get(f"camera/inspection/{found['sequence']}.jpg")).content
        label = found["label"]
        assert (label["vehicle_id"], found["trouble"]) == ("demo", None)
        image = _picture(jpeg)
        (code,) = zxingcpp.read_barcodes(image)
        assert code.text == label["payload"]
        scale = found["width_px"] / image.shape[1]
        place = code.position
        read = np.array([(p.x, p.y) for p in (place.top_left, place.top_right, place.bottom_right)])
        fitted = np.array(label["outline_px"])[::POINTS_PER_SIDE]
        assert abs(fitted[:3] - scale * read).max() < NEAR_PX * scale

        pose = label["pose"]
        assert pose["source"] == "edges"
        settings = scene.services.settings
        joints = scene.services.supervisor.telemetry.require().measured.position
        truth = scene.garage.world.car.T_base_label[:3, 3]

        T_base_camera = base_from_camera(settings.geometry, settings.camera.mount, joints)
        seen = T_base_camera[:3, :3] @ pose["position_mm"] + T_base_camera[:3, 3]
        assert np.linalg.norm(seen - truth) < 5.0  # the simulated mount is a little off, too
        assert 0 < pose["ellipse"]["minor_px"] <= pose["ellipse"]["major_px"] < 1.0

    on_api(scenario, parked=True)


def test_health_is_that_of_the_sensor() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        first = (await client.get("camera/inspection")).json()
        assert first["frames_per_s"] is None
        for _ in range(3):
            newest = (await client.get("camera/inspection", params={"after": 1})).json()
            await scene.later(0.3)
        imaging = scene.services.settings.simulation.parameters.imaging
        assert newest["frames_per_s"] == pytest.approx(imaging.frames_per_s, rel=0.05)
        assert newest["exposure_ms"] > 0
        assert 0 < newest["age_s"] < 1
        assert 10 < newest["brightness"] < 245

    on_api(scenario, parked=True)


def test_the_camera_rests_when_nobody_looks_and_old_pictures_are_forgotten() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        inspector = scene.services.technician.camera
        rested = [inspector.resting]
        known = 0
        for _ in range(KEPT + 2):
            known = (await client.get("camera/inspection", params={"after": known})).json()[
                "sequence"
            ]
        assert len(inspector._pictures) <= KEPT
        problem(await client.get("camera/inspection/1.jpg"), 404, "not_found")
        rested.append(inspector.resting)
        await scene.later(2 * INSPECTION_PATIENCE_S)
        assert [*rested, inspector.resting] == [True, False, True]
        assert inspector._pictures == {}

    on_api(scenario)


def test_a_label_of_nobody_has_an_outline_and_no_pose() -> None:
    async def scenario(_: Scene, client: httpx.AsyncClient) -> None:
        assert (await client.delete("vehicles/demo")).status_code == 204
        found = (await client.get("camera/inspection")).json()
        assert len(found["label"]["outline_px"]) == 4
        assert (found["label"]["pose"], found["label"]["vehicle_id"]) == (None, None)

    on_api(scenario, parked=True)


def test_darkness_and_a_lost_camera_are_said_in_words() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        scene.garage.camera.fault = CameraFault.DARK
        found = (await client.get("camera/inspection")).json()
        assert found["label"] is None
        assert found["trouble"]["code"] == "picture_too_dark"
        scene.garage.camera.fault = CameraFault.UNPLUGGED
        problem(
            await client.get("camera/inspection", params={"after": found["sequence"]}),
            503,
            "camera_down",
        )
        scene.garage.camera.fault = CameraFault.NONE
        assert (await client.get("camera/inspection")).status_code == 200

    on_api(scenario, parked=True)


def test_the_ellipse_is_that_of_the_covariance() -> None:
    turn = np.array([[np.cos(0.3), -np.sin(0.3)], [np.sin(0.3), np.cos(0.3)]])
    ellipse = ellipse_of(turn @ np.diag([4.0, 0.25]) @ turn.T)
    assert (ellipse.major_px, ellipse.minor_px) == pytest.approx((2.0, 0.5))
    assert np.tan(ellipse.angle_rad) == pytest.approx(np.tan(0.3), abs=1e-3)
