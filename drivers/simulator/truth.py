"""What really happened in the simulated garage: for tests and benchmarks, never for decisions."""

from __future__ import annotations

from dataclasses import dataclass

from drivers.simulator.view import Pose


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
