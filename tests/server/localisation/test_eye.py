"""The eye: what it makes of good, bad and doubtful pictures."""

from __future__ import annotations

import asyncio

import numpy as np
import pytest

from drivers.camera import Frame
from drivers.robot import (
    BoardState,
    CommandedJoints,
    LimitSwitches,
    MeasuredJoints,
    RobotState,
)
from server.config.camera import NO_DOUBT
from server.control.telemetry import Telemetry
from server.localisation.errors import (
    CameraDownError,
    ImplausiblePlaceError,
    LabelSizeWrongError,
)
from server.localisation.eye import Eye
from server.localisation.frames import Pose, base_from_camera
from server.localisation.known_camera import KnownCamera
from server.schema.vehicles import Vehicle
from server.vision.errors import AmbiguousLabelError, EdgesDoNotFitError, LabelJumpedError
from tests.server.vision.label_shots import CAMERA, LABEL, SIZE_MM
from tests.server.vision.pictures import PAYLOAD, pose
from tests.support.label_pictures import Placed, photograph
from tests.support.picture_taking import Shot
from tests.support.robot_cell import GEOMETRY, HOME
from twin.camera_mount import CameraMount
from twin.joints import JointPosition, JointVelocity

MOUNT = CameraMount(x_mm=20.0)
THERE = JointPosition(HOME.rho1_mm + 25.0, HOME.rho2_mm - 25.0, HOME.rho3_mm)
STILL = JointVelocity(0.0, 0.0, 0.0)
VEHICLE = Vehicle(id="zoe", name="Zoe", label_payload=PAYLOAD, label_size_mm=SIZE_MM)


class Scene:
    """A label on a wall, a robot that is where it says, and a camera on it."""

    name = "Scene"

    def __init__(self) -> None:
        self.joints = HOME
        self.lift_mm = 0.0
        self.T_base_label = self.camera_pose() @ pose((5.0, -8.0, 240.0), (3.0, -2.0, 180.0))
        self.copies: list[Pose] = []
        self.telemetry = Telemetry()
        self.pictures = 0
        self.age_s = 0.0
        self.go(HOME)

    def camera_pose(self) -> Pose:
        return base_from_camera(GEOMETRY, MOUNT, self.joints)

    def go(self, joints: JointPosition) -> None:
        self.joints = joints
        self.telemetry.put(
            RobotState(
                sampled_at_s=float(self.pictures),
                received_at_s=float(self.pictures),
                board=BoardState.READY,
                measured=MeasuredJoints(joints, STILL),
                commanded=CommandedJoints(joints, STILL),
                force_n=0.0,
                enabled=True,
                homed=True,
                switches=LimitSwitches(rho1=False, rho2=False, rho3=False),
                queue_free=8,
                segments_done=0,
                fault=None,
            )
        )

    async def open(self) -> None: ...

    async def close(self) -> None: ...

    async def frame(self, *, exposed_after_s: float | None = None) -> Frame:
        self.pictures += 1
        to_camera = np.linalg.inv(self.camera_pose())
        placed = [
            Placed(LABEL, to_camera @ place, self.lift_mm)
            for place in (*self.copies, self.T_base_label)
        ]
        rng = np.random.default_rng(self.pictures)
        image = photograph(CAMERA, placed, Shot(), rng)
        asked_s = asyncio.get_running_loop().time() if exposed_after_s is None else exposed_after_s
        return Frame(image, asked_s - self.age_s, self.pictures)


@pytest.fixture
def scene() -> Scene:
    return Scene()


@pytest.fixture
def eye(scene: Scene) -> Eye:
    return Eye(scene, KnownCamera(CAMERA, MOUNT, NO_DOUBT), GEOMETRY, scene.telemetry)


async def test_the_label_is_located_and_measured(scene: Scene, eye: Eye) -> None:
    seen = await eye.look(VEHICLE)
    assert seen is not None
    assert eye.refusal is None
    scene.go(THERE)
    measured = await eye.measure(VEHICLE, 4, seen)
    assert measured is not None
    np.testing.assert_allclose(measured.T_base_label, scene.T_base_label, atol=0.05)
    assert eye.label_size.ratio == pytest.approx(1.0, abs=0.001)
    assert eye.label_size.sigma < 0.05


async def test_without_a_label_there_is_nothing_but_a_reason(scene: Scene, eye: Eye) -> None:
    scene.T_base_label[2, 3] += 50_000.0

    assert await eye.look(VEHICLE) is None
    assert eye.refusal is not None
    assert eye.refusal.code == "no_code"
    assert await eye.measure(VEHICLE, 3, None) is None


async def test_a_label_that_comes_off_is_never_measured(scene: Scene, eye: Eye) -> None:
    scene.lift_mm = 18.0

    assert await eye.look(VEHICLE) is None
    with pytest.raises(EdgesDoNotFitError):
        await eye.measure(VEHICLE, 3, None)


async def test_a_copy_of_the_label_stops_the_measurement(scene: Scene, eye: Eye) -> None:
    beside = scene.T_base_label.copy()
    scene.T_base_label[:3, 3] += (35.0, 0.0, 60.0)
    beside[:3, 3] += (-55.0, 0.0, 60.0)
    scene.copies = [beside]

    with pytest.raises(AmbiguousLabelError):
        await eye.measure(VEHICLE, 3, None)


async def test_a_car_that_moved_meanwhile_is_noticed(scene: Scene, eye: Eye) -> None:
    seen = await eye.look(VEHICLE)
    scene.T_base_label[0, 3] += 30.0
    assert await eye.look(VEHICLE, seen) is None
    with pytest.raises(LabelJumpedError):
        await eye.measure(VEHICLE, 3, seen)


async def test_a_label_where_no_car_is_is_refused(eye: Eye) -> None:
    large = VEHICLE.model_copy(update={"label_size_mm": 200.0})  # so it seems 800 mm away

    assert await eye.look(large) is None
    with pytest.raises(ImplausiblePlaceError):
        await eye.measure(large, 3, None)


async def test_a_wrong_size_is_noticed_from_the_second_place(scene: Scene, eye: Eye) -> None:
    wrong = VEHICLE.model_copy(update={"label_size_mm": 52.0})

    seen = await eye.look(wrong)
    assert seen is not None  # one picture cannot tell
    scene.go(THERE)
    with pytest.raises(LabelSizeWrongError) as caught:
        await eye.measure(wrong, 4, seen)
    assert caught.value.context["measured_mm"] == pytest.approx(60.0, abs=0.3)


async def test_an_old_picture_is_no_picture(scene: Scene, eye: Eye) -> None:
    scene.age_s = 0.3
    with pytest.raises(CameraDownError, match=r"0\.3 s old"):
        await eye.look(VEHICLE)
    with pytest.raises(CameraDownError):
        await eye.measure(VEHICLE, 3, None)
