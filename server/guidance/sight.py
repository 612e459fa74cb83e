"""What one picture says about an arriving car: a sighting, or why there is none."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import zxingcpp

from drivers.camera import CameraModel
from server.guidance.finder_patterns import unread_module_px
from server.guidance.model import Array, Sighting, Unseen
from server.localisation.socket_pose import socket_from_label
from server.schema.vehicles import Vehicle
from server.vision import LabelPose, Locator, PoseRejectedError, VisionError
from server.vision.errors import MirroredCodeError, PictureTooBrightError, PictureTooDarkError
from server.vision.gates import Gates
from server.vision.label_pose import PoseSource
from server.vision.markers.code import Code, Image
from server.vision.markers.qr_codes import QrCodes
from server.vision.markers.qr_modules import exact_modules
from server.vision.markers.qr_reading import read_window
from server.vision.markers.window import Window, window_around
from server.vision.picture_checks import no_code
from twin.geometry import RobotGeometry

JUMP_MM, JUMP_DEG = 150.0, 15.0
"""A car that brakes is not where it was expected; between two jobs nothing can be hurt by it."""

FOLLOW_WITHIN_MM = 900.0
"""Nearer than this an expectation is good enough to find a label that cannot be decoded now."""

READABLE_MODULE_PX = 3.0
"""A code whose modules are larger can be read when it is whole and clean; see README.md."""

THOROUGH_EVERY = 8
"""So many looks without a label, and one goes to all lengths."""

CORNERS_EVERY = 4
"""So many looks that found nothing, and one looks for the corners of a label."""

_MODULES = 25
_SMALLEST_SIDE_PX = 16.0
_FORMATS = zxingcpp.BarcodeFormats([zxingcpp.BarcodeFormat.QRCodeModel2])


@dataclass(frozen=True, slots=True)
class Expected:
    """Where a label should be.

    Attributes:
        vehicle_id: Whose it is.
        T_camera_label: Its pose.
    """

    vehicle_id: str
    T_camera_label: Array


class LabelSight:
    """Looks for the labels of known vehicles, for people to be told, never for the robot to move.

    The accurate fit is used where it passes its gates; a label that is too far away or damaged
    for it still gives a place from its corners. Not for use by several threads at once.

    Args:
        optics: Of the camera.
        geometry: Of the robot.
    """

    def __init__(self, optics: CameraModel, geometry: RobotGeometry) -> None:
        self._locator = Locator(optics, Gates(jump_mm=JUMP_MM, jump_deg=JUMP_DEG))
        self._focal_px = optics.fx
        self._quick_looks = 0
        self._blind_looks = 0
        self._corners = Unseen.NOTHING
        self._codes = QrCodes()
        z_axis = np.array(geometry.insertion_axis)
        x_axis = np.array([1.0, 0.0, 0.0])
        self._across = np.stack((x_axis, np.cross(z_axis, x_axis)))

    def look(
        self,
        image: Image,
        at_s: float,
        T_base_camera: Array,
        vehicles: Sequence[Vehicle],
        expected: Expected | None,
    ) -> Sighting | Unseen:
        """Find the socket of the one known vehicle in a picture.

        Args:
            image: Grey values of the camera's resolution.
            at_s: When it was taken.
            T_base_camera: Where the camera was.
            vehicles: Those that are known.
            expected: Where the label is expected, if it was seen a moment ago.

        Raises:
            ImageSizeMismatchError: the picture is not of the camera's resolution.
        """
        if not vehicles:
            return Unseen.NO_VEHICLE
        found: list[Code] | Unseen = self._read(image)
        if not found and expected is not None:
            followed = self._followed(image, vehicles, expected)
            if followed is not None:
                return self._sighting(*followed, at_s, T_base_camera)
        if not found:
            found = self._near_unreadable(image)
        if isinstance(found, Unseen):
            return found
        chosen = self._chosen(found, vehicles)
        if isinstance(chosen, Unseen):
            return chosen
        code, vehicle = chosen
        pose = self._pose(image, code, vehicle)
        if isinstance(pose, Unseen):
            return pose
        return self._sighting(pose, vehicle, at_s, T_base_camera)

    def _read(self, image: Image) -> list[Code]:
        """Codes in the whole picture; mostly quickly, now and then with every means there is.

        The means against darkness, glare and noise take ten times as long.
        """
        self._quick_looks += 1
        if self._quick_looks < THOROUGH_EVERY:
            codes = read_window(Window(image, 1.0, (0.0, 0.0)))
        else:
            codes = self._codes.find(image)
        if codes or self._quick_looks >= THOROUGH_EVERY:
            self._quick_looks = 0
        codes.sort(key=lambda code: -code.area_px)
        return [
            code
            if code.mirrored
            else replace(code, modules=exact_modules(code.payload, code.modules))
            for code in codes
        ]

    @staticmethod
    def _chosen(
        codes: Sequence[Code], vehicles: Sequence[Vehicle]
    ) -> tuple[Code, Vehicle] | Unseen:
        """The largest label of a known vehicle."""
        by_payload = {vehicle.label_payload: vehicle for vehicle in vehicles}
        known = [code for code in codes if code.payload in by_payload]
        if not known:
            return Unseen.OTHER_LABEL
        code = known[0]
        alike = [other for other in known[1:] if other.payload == code.payload]
        if any(not other.is_same_place(code) for other in alike):
            return Unseen.TWICE
        return code, by_payload[code.payload]

    def _pose(self, image: Image, code: Code, vehicle: Vehicle) -> LabelPose | Unseen:
        """The accurate pose, or the one of the corners.

        What a rolling shutter does to a moving label is left in: the fit that takes it out has
        more freedom, and the few pixels of a label far away do not tell a shear from a tilt. The
        track counts on it instead.
        """
        try:
            return self._locator.fit(image, code, vehicle.label_size_mm)
        except MirroredCodeError:
            return Unseen.MIRRORED
        except PoseRejectedError:
            try:
                return self._locator.coarse(code, vehicle.label_size_mm)
            except PoseRejectedError:
                return Unseen.TOO_DIRTY

    def _followed(
        self, image: Image, vehicles: Sequence[Vehicle], expected: Expected
    ) -> tuple[LabelPose, Vehicle] | None:
        """The expected label, blurred or dazzled for a moment, in its place; else None."""
        vehicle = next((v for v in vehicles if v.id == expected.vehicle_id), None)
        if vehicle is None or expected.T_camera_label[2, 3] > FOLLOW_WITHIN_MM:
            return None
        try:
            pose = self._locator.locate(
                image,
                label_size_mm=vehicle.label_size_mm,
                expected_payload=vehicle.label_payload,
                predicted=expected.T_camera_label,
            )
        except VisionError:
            return None
        return pose, vehicle

    def _near_unreadable(self, image: Image) -> list[Code] | Unseen:
        """A code that is there but was not read: once more, enlarged; else why it cannot be."""
        barcodes = zxingcpp.read_barcodes(image, _FORMATS, return_errors=True)
        sides_px = []
        for barcode in barcodes:
            place = barcode.position
            around = (place.top_left, place.top_right, place.bottom_right, place.bottom_left)
            corners = np.array([(corner.x - 0.5, corner.y - 0.5) for corner in around])
            side_px = float(np.linalg.norm(np.roll(corners, -1, axis=0) - corners, axis=1).mean())
            window = window_around(image, corners)
            if side_px < _SMALLEST_SIDE_PX or window is None:
                continue
            codes = read_window(window)
            if codes:
                return codes
            sides_px.append(side_px)
        if sides_px:
            return _too_small_or_dirty(max(sides_px) / _MODULES)
        error = no_code(image)
        if isinstance(error, PictureTooDarkError):
            return Unseen.TOO_DARK
        if isinstance(error, PictureTooBrightError):
            return Unseen.TOO_BRIGHT
        return self._unrecognised(image)

    def _unrecognised(self, image: Image) -> Unseen:
        """Not even an unreadable code was found: perhaps its corners can be; now and then."""
        if self._blind_looks % CORNERS_EVERY == 0:
            module_px = unread_module_px(image)
            self._corners = Unseen.NOTHING if module_px is None else _too_small_or_dirty(module_px)
        self._blind_looks += 1
        return self._corners

    def _sighting(
        self, pose: LabelPose, vehicle: Vehicle, at_s: float, T_base_camera: Array
    ) -> Sighting:
        self._blind_looks = 0
        socket = socket_from_label(pose, T_base_camera, vehicle.socket, at_s)
        module_px = self._focal_px * vehicle.label_size_mm / _MODULES / pose.T_camera_label[2, 3]
        # A turn w of the label in the camera frame turns the axis a by w x a = -[a]x w.
        x, y, z = socket.axis
        turned = -np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
        jacobian = self._across @ turned @ T_base_camera[:3, :3]
        return Sighting(
            at_s=at_s,
            vehicle_id=vehicle.id,
            T_base_label=socket.T_base_label,
            place_mm=socket.T_base_socket[:3, 3].copy(),
            covariance_mm2=socket.covariance,
            lean=self._across @ socket.axis,
            lean_covariance=_at_least(jacobian @ pose.covariance[:3, :3] @ jacobian.T),
            from_camera_mm=socket.T_base_label[:3, 3] - T_base_camera[:3, 3],
            flawed=pose.source is PoseSource.CORNERS and module_px > READABLE_MODULE_PX,
            faces_robot=None if vehicle.driver_faces is None else vehicle.driver_faces == "robot",
        )


def _too_small_or_dirty(module_px: float) -> Unseen:
    return Unseen.TOO_DIRTY if module_px > READABLE_MODULE_PX else Unseen.TOO_FAR


def _at_least(covariance: Array) -> Array:
    """So that it can be inverted, whatever rounding did to it."""
    return np.asarray(covariance + math.radians(0.01) ** 2 * np.eye(2))
