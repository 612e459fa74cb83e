"""Teach a socket: the plug is all the way in, brought there by hand or by a job.

The robot looks at the label, draws the plug out along its axis, and looks again: nothing may have
moved by that. Where the plug was beside the label is where the socket is. Whatever a calibration
of the robot cannot tell - where on the platform the camera sits, how the slide is inclined, the
plug's own place - is the same at the next job, and drops out.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from server.calibration.grade import Grade
from server.calibration.routines.errors import LabelLostError, LabelMovedError, PlugNotInError
from server.calibration.routines.progress import Progress
from server.calibration.routines.stand import Stand
from server.calibration.versions.new_calibration import NewCalibration
from server.control.errors import RobotNotReadyError
from server.control.plug_guard import HELD
from server.localisation.frames import Pose, base_from_camera, inverse, label_from_socket
from server.schema.calibrations import SocketValues
from server.schema.routines import SocketRoutineRequest
from server.schema.vehicles import SocketOffset, Vehicle
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import gamma

MOVED_MM = 0.2
"""A car that rocks by more than this when the plug is drawn stands elsewhere afterwards."""


@dataclass(slots=True, eq=False)
class SocketRoutine:
    """One run. What was seen before an interruption is not used: the plug may have moved.

    Attributes:
        request: What was asked for.
        by: Who asked.
        vehicle: Whose socket.
    """

    request: SocketRoutineRequest
    by: str
    vehicle: Vehicle

    async def run(self, stand: Stand, progress: Progress) -> NewCalibration:
        """Look, draw out, look again.

        Raises:
            PlugNotInError: the slide is not out far enough for that.
            LabelLostError: the label is not to be seen once the plug is out.
            LabelMovedError: the car, or its label, moved when the plug was drawn.
            ControlError, CameraDownError: the robot or the camera gave up.
        """
        progress.done, progress.total = 0, 2
        supervisor = stand.supervisor
        if not supervisor.telemetry.require().homed:
            raise RobotNotReadyError("The robot does not know its position.")
        mated = supervisor.telemetry.require().measured.position
        socket = mated_socket(supervisor.geometry, mated, stand.settings.insertion.depth_mm)
        progress.say("Looking at the label with the plug in the socket.")
        before = await self._label(stand, progress)
        progress.say("Drawing the plug out.")
        await self._draw_out(stand)
        progress.say("Looking at the label with the plug drawn back.")
        after = await self._label(stand, progress)
        if after is None:
            refusal = stand.eye.refusal
            raise LabelLostError(
                f"The label of {self.vehicle.name} cannot be read from before the socket."
                + (f" {refusal.detail}" if refusal is not None else "")
            )
        moved_mm = None if before is None else float(np.linalg.norm((after - before)[:2, 3]))
        if moved_mm is not None and moved_mm > MOVED_MM:
            raise LabelMovedError(
                f"When the plug was drawn out, the label moved by {moved_mm:.2f} mm.",
                moved_mm=round(moved_mm, 3),
            )
        offset = offset_of(inverse(after if before is None else before) @ socket)
        in_use = stand.as_taught(self.vehicle).socket
        return NewCalibration(
            values=SocketValues(vehicle_id=self.vehicle.id, socket=offset),
            made_by=self.by,
            source=f"The plug in the socket of {self.vehicle.name}"[:200],
            grade=Grade.USABLE if moved_mm is None else Grade.GOOD,
            remarks=_remarks(moved_mm),
            # Both on the look that taught nothing; without one, only what was in use can be judged.
            error=None if before is None else missed_mm(after, offset, socket),
            error_in_use=missed_mm(after, in_use, socket),
        )

    async def _draw_out(self, stand: Stand) -> None:
        supervisor, settings = stand.supervisor, stand.settings
        if supervisor.plug.state not in HELD:
            await supervisor.plug.doubt()  # until it is out, nothing may move sideways
        await supervisor.set_force_limit(stand.lease, settings.insertion.withdrawal_force_limit_n)
        here = supervisor.telemetry.require().commanded.position
        out = here._replace(rho3_mm=supervisor.geometry.rho3.min_mm)
        async with supervisor.plug_may_move(settings.supervision.proof_patience_s):
            await supervisor.move_joints(stand.lease, out)
        await supervisor.plug.is_free()

    async def _label(self, stand: Stand, progress: Progress) -> Pose | None:
        """T_base_label as it is believed to be; None where the plug hides it."""
        seen = await stand.sight()
        x_mm, y_mm = stand.platform_mm.tolist()
        progress.looked(x_mm, y_mm, seen=seen is not None)
        if seen is None:
            return None
        joints = stand.supervisor.telemetry.require().measured.position
        camera = base_from_camera(stand.supervisor.geometry, stand.eye.mount, joints)
        return np.asarray(camera @ seen.T_camera_label)


def missed_mm(T_base_label: Pose, offset: SocketOffset, T_base_socket: Pose) -> float:
    """How far beside the socket this look at the label would lead, across the socket's axis [mm].

    Args:
        T_base_label: Where the label was seen.
        offset: Where the socket should be beside it.
        T_base_socket: Where it is.
    """
    led_to = T_base_label @ label_from_socket(offset)
    off = led_to[:3, 3] - T_base_socket[:3, 3]
    axis = T_base_socket[:3, 2]
    return float(np.linalg.norm(off - axis * (off @ axis)))


def mated_socket(geometry: RobotGeometry, mated: JointPosition, depth_mm: float) -> Pose:
    """T_base_socket of the socket that the plug is in, as far as the robot is known.

    Args:
        geometry: Of the robot.
        mated: Where its joints stand.
        depth_mm: How deep the plug is then.

    Raises:
        PlugNotInError: with the slide like this the plug is in no socket.
    """
    way_mm = mated.rho3_mm - geometry.rho3.min_mm
    if way_mm < depth_mm:
        raise PlugNotInError(
            f"The slide is {way_mm:.0f} mm out; a plug that is all the way in needs {depth_mm:.0f}."
        )
    axis = np.array(geometry.insertion_axis)
    pose = np.eye(4)
    pose[:3, 2] = axis
    pose[:3, 0] = -1.0, 0.0, 0.0  # seen by the robot, the label's x runs against the rail
    pose[:3, 1] = np.cross(axis, pose[:3, 0])
    pose[:3, 3] = np.array(gamma.forward(geometry, mated)) - depth_mm * axis
    return pose


def offset_of(T_label_socket: NDArray[np.float64]) -> SocketOffset:
    """A socket's place in the label frame as vehicles have it: turned about x, then about y."""
    x, y, z = T_label_socket[:3, 2].tolist()
    place = T_label_socket[:3, 3].tolist()
    return SocketOffset(
        x_mm=place[0],
        y_mm=place[1],
        z_mm=place[2],
        rotation_x_rad=-math.asin(y),
        rotation_y_rad=math.atan2(x, z),
    )


def _remarks(moved_mm: float | None) -> tuple[str, ...]:
    if moved_mm is not None:
        return ()
    return ("The plug hid the label: nobody saw whether the car moved when it was drawn out.",)
