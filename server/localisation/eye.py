"""Looks at the car: takes a picture, finds the label, and says where the socket is."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from dataclasses import replace

from drivers.camera import CameraDriver, CameraError, CameraModel, Frame
from server.control.board import MOVING
from server.control.telemetry import Telemetry
from server.localisation.errors import CameraDownError, ImplausiblePlaceError
from server.localisation.frames import Pose, base_from_camera, inverse
from server.localisation.known_camera import KnownCamera
from server.localisation.label_size import LabelSizeCheck, SizeEstimate
from server.localisation.plausible_place import require_plausible_place
from server.localisation.socket_pose import SocketPose, socket_from_label
from server.schema.vehicles import Vehicle
from server.vision import (
    AmbiguousLabelError,
    LabelPose,
    Locator,
    PoseRejectedError,
    VisionError,
    combine,
)
from twin.camera_mount import CameraMount
from twin.geometry import RobotGeometry

OnSighting = Callable[[SocketPose, Frame], None]
Refusal = VisionError | ImplausiblePlaceError
OLD_S = 0.05
"""A picture from longer before the question shows where the car was, not where it is."""

_DOUBTS = (PoseRejectedError, AmbiguousLabelError, ImplausiblePlaceError)
"""The label was read, but its pose does not deserve trust."""


class Eye:
    """The camera on the robot together with what it knows of its own place.

    Args:
        camera: Gives pictures.
        known: What it is like and where it sits.
        geometry: Calibrated geometry of the robot.
        telemetry: Where the robot was when a picture was taken.
    """

    def __init__(
        self,
        camera: CameraDriver,
        known: KnownCamera,
        geometry: RobotGeometry,
        telemetry: Telemetry,
    ) -> None:
        self.known = known
        self._camera = camera
        self._geometry = geometry
        self._telemetry = telemetry
        self._locator = Locator(known.optics)
        self._listeners: list[OnSighting] = []
        self._size = LabelSizeCheck()
        self._refusal: Refusal | None = None

    @property
    def optics(self) -> CameraModel:
        """The camera's calibrated model."""
        return self.known.optics

    @property
    def mount(self) -> CameraMount:
        """Where it sits on the platform."""
        return self.known.mount

    def recalibrate(self, known: KnownCamera) -> None:
        """From now on the camera is like this. What the looks said of the label is forgotten."""
        self.known = known
        self._locator = Locator(known.optics)
        self._size = LabelSizeCheck()

    def listen(self, listener: OnSighting) -> None:
        """Call ``listener`` with every pose and the picture it came from (the last of several)."""
        self._listeners.append(listener)

    @property
    def refusal(self) -> Refusal | None:
        """Why the last picture gave no pose; None if it gave one."""
        return self._refusal

    @property
    def label_size(self) -> SizeEstimate:
        """What the looks from different places say about the label's true size."""
        return self._size.estimate

    async def look(self, vehicle: Vehicle, expected: SocketPose | None = None) -> SocketPose | None:
        """Take one picture now and locate the vehicle's socket in it.

        Args:
            vehicle: Whose label to look for.
            expected: Where it was last seen, for looks on the way; without it the robot must
                stand still.

        Returns:
            The socket's pose, or None when the label is not in the picture (or not good enough);
            then ``refusal`` says why.

        Raises:
            CameraDownError: the camera does not deliver.
            LabelSizeWrongError: this look and earlier ones show that the size is wrong.
        """
        if expected is None:
            self._size = LabelSizeCheck()  # nobody says that the car still stands where it stood
        still = expected is None
        frame = await self.frame()
        sighting = await self._locate(frame, vehicle, expected, still=still)
        if sighting is None:
            return None
        return await self._socket(sighting, frame, vehicle, still=still)

    async def measure(
        self, vehicle: Vehicle, frames: int, expected: SocketPose | None
    ) -> SocketPose | None:
        """Average several pictures taken at standstill.

        Returns:
            The combined pose, or None when fewer than half of the pictures show the label.

        Raises:
            CameraDownError: the camera does not deliver.
            LabelSizeWrongError: this look and earlier ones show that the size is wrong.
            PoseRejectedError: the label is there, but its pose failed a gate; its kinds say which.
            AmbiguousLabelError: the label is there more than once.
            ImplausiblePlaceError: it is where no parked car is.
        """
        averaged = await self._average(vehicle, frames, expected)
        if averaged is None:
            return None
        sighting, frame = averaged
        return await self._socket(sighting, frame, vehicle, still=True)

    async def sight(self, vehicle: Vehicle, frames: int) -> LabelPose | None:
        """Average the label itself in the camera frame, at standstill, whatever the robot is like.

        Returns:
            Its pose, or None when fewer than half of the pictures show it; ``refusal`` says why.

        Raises:
            CameraDownError, PoseRejectedError, AmbiguousLabelError, ImplausiblePlaceError: as in
                ``measure``.
        """
        averaged = await self._average(vehicle, frames, None)
        return None if averaged is None else averaged[0]

    async def frame(self) -> Frame:
        """A picture whose exposure begins from now on.

        Raises:
            CameraDownError: the camera does not deliver.
        """
        asked_s = asyncio.get_running_loop().time()
        try:
            frame = await self._camera.frame(exposed_after_s=asked_s)
        except CameraError as error:
            raise CameraDownError(str(error)) from error
        old_s = asked_s - frame.captured_at_s
        if not old_s <= OLD_S:
            raise CameraDownError(
                f"The camera gave a picture that was {old_s:.1f} s old when it was asked for one."
            )
        return frame

    async def _average(
        self, vehicle: Vehicle, frames: int, expected: SocketPose | None
    ) -> tuple[LabelPose, Frame] | None:
        sightings: list[LabelPose] = []
        doubts: list[Refusal] = []
        for _ in range(frames):
            frame = await self.frame()
            sighting = await self._locate(frame, vehicle, expected, still=True)
            if sighting is not None:
                sightings.append(sighting)
            elif isinstance(self._refusal, _DOUBTS):
                doubts.append(self._refusal)
        if sightings and 2 * len(sightings) >= frames:
            return combine(sightings), frame
        if 2 * len(doubts) >= frames:
            raise doubts[-1]
        return None

    async def _locate(
        self, frame: Frame, vehicle: Vehicle, expected: SocketPose | None, *, still: bool
    ) -> LabelPose | None:
        self._refusal = None
        T_base_camera = await self._camera_pose(frame)
        predicted = None
        if expected is not None:
            predicted = inverse(T_base_camera) @ expected.T_base_label
        try:
            sighting = await asyncio.to_thread(
                self._locator.locate,
                frame.image,
                label_size_mm=vehicle.label_size_mm,
                expected_payload=vehicle.label_payload,
                predicted=predicted,
                moving=not still,
            )
            if not still and predicted is not None:
                sighting = _with_attitude(sighting, predicted)
            require_plausible_place(self._geometry, T_base_camera @ sighting.T_camera_label)
        except (VisionError, ImplausiblePlaceError) as error:
            self._refusal = error
            return None
        return sighting

    async def _socket(
        self, sighting: LabelPose, frame: Frame, vehicle: Vehicle, *, still: bool
    ) -> SocketPose:
        T_base_camera = await self._camera_pose(frame)
        if still:
            self._size.add(sighting, T_base_camera)
            self._size.require_right_size(vehicle.label_size_mm)
        socket = replace(
            socket_from_label(sighting, T_base_camera, vehicle.socket, frame.captured_at_s),
            from_standstill=still,
        )
        for listener in self._listeners:
            listener(socket, frame)
        return socket

    @property
    def _moving(self) -> bool:
        return self._telemetry.require().board in MOVING

    async def _camera_pose(self, frame: Frame) -> Pose:
        if self._moving:
            await self._telemetry.reach(frame.captured_at_s)
        joints = self._telemetry.joints_at(frame.captured_at_s)
        return base_from_camera(self._geometry, self.mount, joints)


def _with_attitude(sighting: LabelPose, known: Pose) -> LabelPose:
    """A look on the way with the label turned as it was seen from standstill.

    The robot only translates and the car stands, so the attitude cannot have changed; a rolling
    shutter turns what it sees from a moving robot by a degree or two. The covariance stays that of
    the look alone.
    """
    T_camera_label = sighting.T_camera_label.copy()
    T_camera_label[:3, :3] = known[:3, :3]
    return replace(sighting, T_camera_label=T_camera_label)
