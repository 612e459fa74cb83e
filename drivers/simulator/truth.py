"""What really happened in the simulated garage: for tests and benchmarks, never for decisions."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from drivers.simulator.car import ParkedCar
from drivers.simulator.parameters import ContactParameters
from drivers.simulator.plant import Plant, PlantState
from drivers.simulator.socket_contact import Place
from drivers.simulator.view import Pose
from drivers.simulator.watching import plug_pose
from twin.as_built import PlanarAsBuilt
from twin.joints import JointPosition, TipPosition


@dataclass(frozen=True, slots=True)
class GroundTruth:
    """The truth at one instant.

    Attributes:
        at_s: When.
        T_base_plug: Pose of the plug: origin the centre of its tip, z the insertion axis.
        T_base_socket: Pose of the socket: origin the centre of its face, z into the car.
        lateral_error_mm: Distance of the plug's axis from the socket's centre in the plane of
            its face: at the last entry, before contact centred the plug, or as it would be if
            the plug went straight in now.
        insertion_depth_mm: Plug tip behind the socket's face; negative in front of it.
        contact_force_n: Force of the socket against the plug, positive against going in.
        max_contact_force_n: Largest contact force since the car was parked, in either direction.
        seated: The plug is fully in.
        jammed: The plug missed the opening and pushes against the panel.
        lateral_violation_mm: Largest sideways motion of the platform with the plug inserted.
        locked: The connector lock is closed.
        load_breaks: How often the plug was pulled while power flowed.
    """

    at_s: float
    T_base_plug: Pose
    T_base_socket: Pose
    lateral_error_mm: float
    insertion_depth_mm: float
    contact_force_n: float
    max_contact_force_n: float
    seated: bool
    jammed: bool
    lateral_violation_mm: float
    locked: bool
    load_breaks: int


def ground_truth(
    plant: Plant,
    state: PlantState,
    car: ParkedCar,
    numbers: ContactParameters,
    *,
    load_breaks: int,
) -> GroundTruth:
    """The truth about a state of the plant.

    Args:
        plant: The robot as built.
        state: Its state.
        car: The car in front of it.
        numbers: Say when a plug is seated.
        load_breaks: How often the plug was pulled while power flowed.
    """
    plug, socket, contact = plug_pose(plant, state), car.T_base_socket, state.contact
    depth_mm = float((plug[:3, 3] - socket[:3, 3]) @ socket[:3, 2])
    lateral_mm = contact.entry_lateral_mm
    return GroundTruth(
        at_s=state.t_s,
        T_base_plug=plug,
        T_base_socket=socket.copy(),
        lateral_error_mm=lateral_at_face_mm(plug, socket) if lateral_mm is None else lateral_mm,
        insertion_depth_mm=depth_mm,
        contact_force_n=contact.force_n,
        max_contact_force_n=state.max_force_n,
        seated=contact.place is Place.IN_SOCKET and depth_mm >= numbers.seated_depth_mm,
        jammed=contact.place is Place.AGAINST_PANEL,
        lateral_violation_mm=state.lateral_violation_mm,
        locked=contact.locked_at_mm is not None,
        load_breaks=load_breaks,
    )


def mechanism_from_below(
    plant: Plant, zero: JointPosition, play_mm: tuple[float, float, float]
) -> PlanarAsBuilt:
    """The mechanism by the board's counting, when both carriages come from below.

    Args:
        plant: The robot as built.
        zero: True positions of the motors when the board's coordinates read 0.
        play_mm: Of each joint: all of it is taken up.
    """
    built = plant.mechanism
    left_mm = built.left_scale * (zero.rho1_mm - 0.5 * play_mm[0])
    right_mm = built.right_scale * (zero.rho2_mm - 0.5 * play_mm[1])
    return built.model_copy(
        update={
            "left_foot_x_mm": built.left_foot_x_mm + left_mm * math.cos(built.left_rail_rad),
            "left_foot_y_mm": built.left_foot_y_mm + left_mm * math.sin(built.left_rail_rad),
            "right_foot_x_mm": built.right_foot_x_mm - right_mm * math.cos(built.right_rail_rad),
            "right_foot_y_mm": built.right_foot_y_mm - right_mm * math.sin(built.right_rail_rad),
        }
    )


def state_from_below(
    joints: JointPosition, zero: JointPosition, play_mm: tuple[float, float, float]
) -> PlantState:
    """The plant at rest once all joints have come from below.

    Args:
        joints: Where the board has sent them.
        zero: True positions of the motors when the board's coordinates read 0.
        play_mm: Of each joint.
    """
    taken_up = (q + z - 0.5 * p for q, z, p in zip(joints, zero, play_mm, strict=True))
    return PlantState(0.0, joints, JointPosition(*taken_up))


def tip_from_below(
    plant: Plant, joints: JointPosition, zero: JointPosition, play_mm: tuple[float, float, float]
) -> TipPosition:
    """Where the plug's tip really comes to rest when all joints come from below [mm].

    Args:
        plant: The robot as built.
        joints: Where the board sends them.
        zero: True positions of the motors when the board's coordinates read 0.
        play_mm: Of each joint.
    """
    return plant.tip(state_from_below(joints, zero, play_mm))


def lateral_at_face_mm(plug: Pose, socket: Pose) -> float:
    """Where the plug's axis pierces the plane of the socket's face, from the face's centre.

    Args:
        plug: T_base_plug.
        socket: T_base_socket.
    """
    axis, normal = plug[:3, 2], socket[:3, 2]
    to_face = socket[:3, 3] - plug[:3, 3]
    pierced = axis * float(to_face @ normal) / float(axis @ normal)
    return float(np.linalg.norm(pierced - to_face))
