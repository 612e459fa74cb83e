"""The camera's picture for the 3D view."""

from __future__ import annotations

from types import SimpleNamespace

import cv2
import httpx
import numpy as np
import pytest
from fastapi import FastAPI

from drivers.camera import CameraTimeoutError, Frame
from server.api.dependencies import running_services
from server.api.problems import install_handlers
from server.api.twin import twin_router
from server.api.twin.camera_picture import WIDTH_PX
from server.live.camera_feed import CameraFeed
from twin.camera_mount import CameraMount
from twin.geometry import RobotGeometry
from twin.scene import TwinHost


class Camera:
    """Sees a garage that is dark on the left and bright on the right."""

    name = "Test camera"
    failure: Exception | None = None

    async def open(self) -> None: ...

    async def close(self) -> None: ...

    async def frame(self, *, exposed_after_s: float | None = None) -> Frame:
        del exposed_after_s
        if self.failure is not None:
            raise self.failure
        image = np.full((1232, 1640), 20, dtype=np.uint8)
        image[:, 820:] = 220
        return Frame(image, 0.0, 1)


@pytest.fixture
def camera() -> Camera:
    return Camera()


@pytest.fixture
def client(camera: Camera) -> httpx.AsyncClient:
    app = FastAPI()
    host = TwinHost(RobotGeometry(), CameraMount(), 1.0, 4 / 3)
    app.include_router(twin_router(host))
    install_handlers(app)
    services = SimpleNamespace(camera=CameraFeed(camera, 0.2))
    app.dependency_overrides[running_services] = lambda: services
    return httpx.AsyncClient(transport=httpx.ASGITransport(app), base_url="http://robot")


async def test_it_is_small_and_shows_what_the_camera_sees(client: httpx.AsyncClient) -> None:
    response = await client.get("/twin/camera.jpg")
    assert response.status_code == 200
    assert response.headers["content-type"] == "image/jpeg"
    assert response.headers["cache-control"] == "no-store"
    assert len(response.content) < 20_000
    image = cv2.imdecode(np.frombuffer(response.content, np.uint8), cv2.IMREAD_GRAYSCALE)
    assert image is not None
    assert image.shape == (round(WIDTH_PX * 1232 / 1640), WIDTH_PX)
    assert image[:, :100].mean() == pytest.approx(20, abs=3)
    assert image[:, -100:].mean() == pytest.approx(220, abs=3)


async def test_a_camera_that_fails_is_a_problem_and_not_a_picture(
    client: httpx.AsyncClient, camera: Camera
) -> None:
    camera.failure = CameraTimeoutError("The camera did not answer.")
    response = await client.get("/twin/camera.jpg")
    assert response.status_code == 503
    assert response.json()["code"] == "camera_down"
