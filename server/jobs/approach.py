"""From a measured socket to the joints of the way in, and where to wait."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from server.config.insertion import InsertionSettings
from server.config.park import ParkSettings
from server.control.plug_guard import Corridor
from server.localisation.errors import SocketUnreachableError
from server.localisation.socket_pose import SocketPose
from twin.geometry import RobotGeometry
from twin.joints import JointPosition, TipPosition
from twin.kinematics import KinematicsError, gamma


class LateralOffset(NamedTuple):
    """Beside the measured centre of the socket, across the insertion axis [mm]."""

    right_mm: float
    up_mm: float


AT_THE_CENTRE = LateralOffset(0.0, 0.0)

LEAD_MM = 0.4
"""So far before its goal, on both rails, the plug waits for the measurement at standstill. The
correction then goes on upwards, and play stays taken up without a detour."""


def tip_on_way_in(
    geometry: RobotGeometry,
    socket: SocketPose,
    depth_mm: float,
    offset: LateralOffset = AT_THE_CENTRE,
) -> TipPosition:
    """Plug tip on the way in, ``depth_mm`` behind the socket's face (negative: before it).

    The way in is the robot's own insertion axis through the centre of the face, or ``offset``
    beside it: the small tilt of a parked car is taken up by the plug holder.
    """
    place = np.array(socket.entry) + depth_mm * np.array(geometry.insertion_axis)
    place += _across(geometry, offset)
    return TipPosition(*(float(c) for c in place))


def pre_insertion(
    geometry: RobotGeometry,
    socket: SocketPose,
    settings: InsertionSettings,
    offset: LateralOffset = AT_THE_CENTRE,
) -> JointPosition:
    """Joints with the plug before the socket, or ``offset`` beside that, ready to go in.

    Raises:
        SocketUnreachableError: the plug cannot get there, or from there not all the way in.
    """
    try:
        gamma.inverse(geometry, tip_on_way_in(geometry, socket, settings.depth_mm, offset))
        return gamma.inverse(
            geometry, tip_on_way_in(geometry, socket, -settings.pre_insertion_distance_mm, offset)
        )
    except KinematicsError as error:
        entry = socket.entry
        raise SocketUnreachableError(
            where_it_stands(geometry, entry, settings),
            x_mm=round(entry.x_mm, 1),
            y_mm=round(entry.y_mm, 1),
            z_mm=round(entry.z_mm, 1),
            reason=str(error),
        ) from error


def waiting_before(goal: JointPosition) -> JointPosition:
    """Where to stand for the measurement that says where the goal really is."""
    return goal._replace(rho1_mm=goal.rho1_mm - LEAD_MM, rho2_mm=goal.rho2_mm - LEAD_MM)


def where_it_stands(
    geometry: RobotGeometry, entry: TipPosition, settings: InsertionSettings
) -> str:
    """How far the socket is from where it should be, in words for whoever parked the car.

    Left and right are those of a driver who faces the robot.
    """
    box, slide = geometry.regular_box, geometry.rho3
    platform, rho3_mm = gamma.platform_for_tip(geometry, entry)
    right_mm = platform.x_mm - box.center_x_mm
    up_mm = platform.y_mm - box.center_y_mm
    complaints = [
        f"{excess_mm:.0f} mm too {direction}"
        for excess_mm, direction in (
            (rho3_mm + settings.depth_mm - slide.max_mm, "far from the robot"),
            (slide.min_mm + settings.pre_insertion_distance_mm - rho3_mm, "near to the robot"),
            (right_mm - box.width_mm / 2, "far to the right"),
            (-right_mm - box.width_mm / 2, "far to the left"),
            (up_mm - box.height_mm / 2, "high"),
            (-up_mm - box.height_mm / 2, "low"),
        )
        if excess_mm >= 0.5
    ]
    if not complaints:
        return "The socket is just outside what the robot can reach."
    return f"The socket is {' and '.join(complaints)}."


def corridor(
    geometry: RobotGeometry,
    at: JointPosition,
    socket: SocketPose,
    settings: InsertionSettings,
) -> Corridor:
    """The way in from where the robot stands: rho1 and rho2 as they are, rho3 by the socket."""
    face = gamma.platform_for_tip(geometry, socket.entry)[1]
    return Corridor(
        rho1_mm=at.rho1_mm,
        rho2_mm=at.rho2_mm,
        clear_rho3_mm=face - settings.pre_insertion_distance_mm,
        face_rho3_mm=face,
        depth_rho3_mm=face + settings.depth_mm,
    )


def lateral_error_mm(
    geometry: RobotGeometry,
    at: JointPosition,
    socket: SocketPose,
    offset: LateralOffset = AT_THE_CENTRE,
) -> float:
    """Distance of the plug's way from the aim, across the insertion axis [mm].

    Args:
        geometry: The robot.
        at: Where it stands.
        socket: Where the socket is.
        offset: The aim is so far beside the socket's centre.
    """
    axis = np.array(geometry.insertion_axis)
    away = np.array(gamma.forward(geometry, at)) - np.array(socket.entry)
    away -= _across(geometry, offset)
    return float(np.linalg.norm(away - (away @ axis) * axis))


def _across(geometry: RobotGeometry, offset: LateralOffset) -> NDArray[np.float64]:
    """An offset in the base frame, perpendicular to the insertion axis [mm]."""
    theta = geometry.theta_rad
    upwards = np.array([0.0, math.cos(theta), -math.sin(theta)])
    return offset.right_mm * np.array([1.0, 0.0, 0.0]) + offset.up_mm * upwards


def parking_joints(geometry: RobotGeometry, park: ParkSettings) -> JointPosition:
    """Joints of the parking place.

    Raises:
        UnreachableError: the configured place is out of reach.
    """
    dy_mm, z_mm = gamma.tip_offset(geometry, park.rho3_mm)
    return gamma.inverse(geometry, TipPosition(park.x_mm, park.y_mm + dy_mm, z_mm))
