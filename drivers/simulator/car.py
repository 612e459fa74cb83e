"""The parked car: where its socket and its label really are, and what is known about them."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from drivers.simulator import poses
from drivers.simulator.parameters import CarParameters, ContactParameters
from drivers.simulator.randomness import clipped_normal
from drivers.simulator.view import Pose
from twin.geometry import RobotGeometry

FAR_AWAY_MM = 50_000.0
"""How far along z a car stands that has left."""


@dataclass(frozen=True, slots=True)
class KnownOffset:
    """Where the socket sits relative to the label, as measured once for this vehicle.

    The origin is the centre of the socket's face in the label frame. The angles turn the label's
    z axis onto the socket's axis: first about the label's x, then about its y.
    """

    x_mm: float
    y_mm: float
    z_mm: float
    rotation_x_rad: float
    rotation_y_rad: float


@dataclass(frozen=True, slots=True)
class ParkedCar:
    """One car in its place.

    Attributes:
        T_base_label: True pose of the label.
        T_base_socket: True pose of the socket: origin the centre of its face, z into the car.
        known_offset: What the owner's settings say about label and socket.
        vehicle_id: Whose label it is.
        payload: Text in the label's QR code.
        label_size_mm: Side of the code without its quiet zone.
        peak_force_n: Insertion force of its socket at the worst depth.
        wanted_wh: Energy it takes until it is full.
    """

    T_base_label: Pose
    T_base_socket: Pose
    known_offset: KnownOffset
    vehicle_id: str
    payload: str
    label_size_mm: float
    peak_force_n: float
    wanted_wh: float

    def moved(self, displacement: Pose) -> ParkedCar:
        """The same car elsewhere; the displacement acts in the base frame, shape (4, 4)."""
        return replace(
            self,
            T_base_label=displacement @ self.T_base_label,
            T_base_socket=displacement @ self.T_base_socket,
        )

    def driven_away(self) -> ParkedCar:
        """The same car, far out of reach and sight."""
        label, socket = self.T_base_label.copy(), self.T_base_socket.copy()
        label[2, 3] += FAR_AWAY_MM
        socket[2, 3] += FAR_AWAY_MM
        return replace(self, T_base_label=label, T_base_socket=socket)

    def without_label(self) -> ParkedCar:
        """The same car with its label out of sight."""
        label = self.T_base_label.copy()
        label[2, 3] += FAR_AWAY_MM
        return replace(self, T_base_label=label)


def park(
    geometry: RobotGeometry,
    car: CarParameters,
    contact: ContactParameters,
    rng: np.random.Generator,
) -> ParkedCar:
    """Draw a car whose socket the nominal robot can reach.

    V must stand anywhere in the width and height of the regular box when the plug tip is level
    with the face, and the face stands anywhere in ``face_z_mm``.

    Args:
        geometry: The robot as drawn.
        car: How cars park.
        contact: For the force of this car's socket.
        rng: Decides.
    """
    straight = poses.facing_the_car(geometry)
    tilt = [clipped_normal(rng, car.tilt_std_rad, car.tilt_max_rad) for _ in range(3)]
    attitude = poses.rotation_y(tilt[0]) @ poses.rotation_x(tilt[1]) @ poses.rotation_z(tilt[2])
    base_socket = poses.pose(straight @ attitude, _face_mm(geometry, car, rng))

    stuck_mm = np.array(car.socket_offset_mm) + rng.normal(0.0, car.sticking_std_mm, 3)
    about_x, about_y = rng.normal(0.0, car.sticking_angle_std_rad, 2)
    label_socket = poses.pose(poses.rotation_y(about_y) @ poses.rotation_x(about_x), stuck_mm)
    x_mm, y_mm, z_mm = (stuck_mm + rng.normal(0.0, car.knowledge_std_mm, 3)).tolist()
    charge = rng.uniform(*car.state_of_charge)
    return ParkedCar(
        T_base_label=base_socket @ poses.inverse(label_socket),
        T_base_socket=base_socket,
        known_offset=KnownOffset(x_mm, y_mm, z_mm, float(about_x), float(about_y)),
        vehicle_id=car.vehicle_id,
        payload=car.vehicle_id,
        label_size_mm=car.label_size_mm,
        peak_force_n=max(rng.normal(contact.peak_force_n, contact.peak_force_std_n), 0.0),
        wanted_wh=max(car.target_state_of_charge - charge, 0.0) * car.battery_wh,
    )


def _face_mm(geometry: RobotGeometry, car: CarParameters, rng: np.random.Generator) -> poses.Vector:
    """Centre of the socket's face in the base frame [mm]."""
    box = geometry.regular_box
    v_x_mm = box.center_x_mm + rng.uniform(-0.5, 0.5) * box.width_mm
    v_y_mm = box.center_y_mm + rng.uniform(-0.5, 0.5) * box.height_mm
    z_mm = rng.uniform(*car.face_z_mm)
    # the slide is inclined: reaching the face's depth also moves the tip up or down
    rho3_mm = (z_mm + geometry.e4z_mm - geometry.e3z_mm) / math.cos(geometry.theta_rad)
    y_mm = v_y_mm + geometry.e3y_mm - geometry.e4y_mm + rho3_mm * math.sin(geometry.theta_rad)
    return np.array([v_x_mm, y_mm, z_mm])
