"""Looks at the car: takes a picture, finds the label, and says where the socket is."""

from __future__ import annotations

import asyncio
from collections.abc import Callable

from drivers.camera import CameraDriver, CameraError, CameraModel, Frame
from server.control.board import MOVING
from server.control.telemetry import Telemetry
from server.localisation.errors import CameraDownError
from server.localisation.frames import Pose, base_from_camera, inverse
from server.localisation.socket_pose import SocketPose, socket_from_label
from server.schema.vehicles import Vehicle
from server.vision import LabelPose, Locator, VisionError, combine
from twin.camera_mount import CameraMount
from twin.geometry import RobotGeometry

OnSighting = Callable[[SocketPose, Frame], None]


class Eye:
    """The camera on the robot together with what it knows of its own place.

    Args:
        camera: Gives pictures.
        optics: Its calibrated model.
        mount: Where it sits on the platform.
        geometry: Calibrated geometry of the robot.
        telemetry: Where the robot was when a picture was taken.
    """

    def __init__(
        self,
        camera: CameraDriver,
        optics: CameraModel,
        mount: CameraMount,
        geometry: RobotGeometry,
        telemetry: Telemetry,
    ) -> None:
        self.optics = optics
        self.mount = mount
        self._camera = camera
        self._geometry = geometry
        self._telemetry = telemetry
        self._locator = Locator(optics)
        self._listeners: list[OnSighting] = []

    def listen(self, listener: OnSighting) -> None:
        """Call ``listener`` with every pose and the picture it came from (the last of several)."""
        self._listeners.append(listener)

    async def look(self, vehicle: Vehicle, expected: SocketPose | None = None) -> SocketPose | None:
        """Take one picture now and locate the vehicle's socket in it.

        Args:
            vehicle: Whose label to look for.
            expected: Where it was last seen; makes finding it quicker.

        Returns:
            The socket's pose, or None when the label is not in the picture (or not good enough).

        Raises:
            CameraDownError: the camera does not deliver.
        """
        frame = await self._frame()
        sighting = await self._locate(frame, vehicle, expected)
        if sighting is None:
            return None
        return await self._socket(sighting, frame, vehicle)

    async def measure(
        self, vehicle: Vehicle, frames: int, expected: SocketPose | None
    ) -> SocketPose | None:
        """Average several pictures taken at standstill.

        Returns:
            The combined pose, or None when fewer than half of the pictures could be used.

        Raises:
            CameraDownError: the camera does not deliver.
        """
        sightings: list[LabelPose] = []
        frame = await self._frame()
        for number in range(frames):
            if number:
                frame = await self._frame()
            sighting = await self._locate(frame, vehicle, expected)
            if sighting is not None:
                sightings.append(sighting)
        if 2 * len(sightings) < frames or not sightings:
            return None
        return await self._socket(combine(sightings), frame, vehicle)

    async def _frame(self) -> Frame:
        try:
            return await self._camera.frame(exposed_after_s=asyncio.get_running_loop().time())
        except CameraError as error:
            raise CameraDownError(str(error)) from error

    async def _locate(
        self, frame: Frame, vehicle: Vehicle, expected: SocketPose | None
    ) -> LabelPose | None:
        predicted = None
        if expected is not None:
            predicted = inverse(await self._camera_pose(frame)) @ expected.T_base_label
        try:
            return await asyncio.to_thread(
                self._locator.locate,
                frame.image,
                label_size_mm=vehicle.label_size_mm,
                expected_payload=vehicle.label_payload,
                predicted=predicted,
            )
        except VisionError:
            return None

    async def _socket(self, sighting: LabelPose, frame: Frame, vehicle: Vehicle) -> SocketPose:
        socket = socket_from_label(
            sighting, await self._camera_pose(frame), vehicle.socket, frame.captured_at_s
        )
        for listener in self._listeners:
            listener(socket, frame)
        return socket

    async def _camera_pose(self, frame: Frame) -> Pose:
        if self._telemetry.require().board in MOVING:
            await self._telemetry.reach(frame.captured_at_s)
        joints = self._telemetry.joints_at(frame.captured_at_s)
        return base_from_camera(self._geometry, self.mount, joints)
