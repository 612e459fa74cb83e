"""Light on the car, and what of it comes back as reflections of lamps."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from drivers.simulator.camera.car_plane import CarPlane, dot
from drivers.simulator.camera.coarse_grid import CoarseGrid, Field
from drivers.simulator.camera.conditions import LampConditions
from drivers.simulator.camera.imaging import ImagingParameters
from drivers.simulator.view import Pose

OWN_LIGHT_AT_MM = 300.0
"""At this distance, straight ahead, the robot's own light has the brightness it is given."""

PAINT_ROUGHNESS_RAD = 0.035


@dataclass(frozen=True, slots=True, eq=False)
class Light:
    """Light on the plane of the car.

    Attributes:
        on_car: Irradiance times the lens's fall-off at the nodes; 1 is a normally lit garage in
            the middle of the picture, shape (m, n).
        lamps: Directions and brightnesses of lamps that are reflected.
    """

    on_car: Field
    lamps: tuple[_Lamp, ...]


@dataclass(frozen=True, slots=True, eq=False)
class _Lamp:
    place_mm: NDArray[np.float64]  # in the frame of the car's plane
    radius_mm: float
    brightness: float


class Lighting:
    """Ambient light, a lamp at the ceiling and the robot's own light.

    Args:
        imaging: Fall-off of the lens and slope of the ambient light.
        lamps: The lamps.
        optics: The camera.
        grid: Where light is worked out.
    """

    def __init__(
        self,
        imaging: ImagingParameters,
        lamps: LampConditions,
        optics: CameraModel,
        grid: CoarseGrid,
    ) -> None:
        self._lamps = lamps
        # The natural fall-off is cos^4 of the angle to the axis, (1 + r^2)^-2.
        natural = (1 + np.sum(grid.rays**2, axis=-1)) ** -2
        self._fall_off = (1 - imaging.vignetting * (1 - natural)).astype(np.float32)
        across = grid.rays[..., 0] * (optics.fx / optics.width)  # -0.5 to 0.5
        slope = 1 + imaging.illumination_gradient * across
        self._ambient = np.asarray(self._fall_off * slope, dtype=np.float32)
        self._scaled: tuple[float, Field] = (1.0, self._ambient)

    def at(self, car: CarPlane | None, T_camera_socket: Pose, ambient: float) -> Light:
        """Light for one picture.

        Args:
            car: The plane of the car; None where no car stands.
            T_camera_socket: Frame in which the place of the ceiling lamp is given.
            ambient: Brightness of the ambient light.
        """
        if self._scaled[0] != ambient:  # the same object for the same light: others cache by it
            self._scaled = (ambient, self._ambient * np.float32(ambient))
        on_car = self._scaled[1]
        if car is None:
            return Light(on_car, ())
        numbers, lamps = self._lamps, []
        if numbers.ceiling and ambient:
            place = np.array(numbers.ceiling_mm)
            brightness = numbers.ceiling * ambient
            lamps.append(_Lamp(place, numbers.ceiling_radius_mm, brightness))
        if numbers.own:
            on_car = on_car + self._own_light(car)
            inverse = np.linalg.inv(T_camera_socket)
            place = inverse[:3, :3] @ np.array(numbers.own_mm) + inverse[:3, 3]
            lamps.append(_Lamp(place, numbers.own_radius_mm, numbers.own))
        return Light(on_car, tuple(lamps))

    def _own_light(self, car: CarPlane) -> Field:
        """Falls off with the square of the distance, the angle of incidence and its own beam."""
        numbers = self._lamps
        way = car.in_camera - np.array(numbers.own_mm, dtype=np.float32)
        distance = np.maximum(np.sqrt(dot(way, way)), 1.0)
        falling = np.abs(way @ car.normal.astype(np.float32)) / distance
        off_axis = np.arctan2(np.hypot(way[..., 0], way[..., 1]), np.maximum(way[..., 2], 1.0))
        beam = 0.5 ** ((off_axis / numbers.own_half_angle_rad) ** 2)
        light = numbers.own * (OWN_LIGHT_AT_MM / distance) ** 2 * falling * beam
        return np.asarray(light * self._fall_off, dtype=np.float32)


def reflections(
    light: Light,
    places_mm: NDArray[np.float32],
    mirrored: NDArray[np.float32],
    roughness_rad: float,
) -> Field:
    """Brightness of the lamps' reflections, relative to that of a white surface in their light.

    A lamp is a disc of its angular radius, smeared by the roughness of the surface, which keeps
    its light: the peak falls as the smear grows.

    Args:
        light: The lamps.
        places_mm: Where the surface is, in the frame of the car's plane, shape (..., 3).
        mirrored: Unit directions into which it mirrors the line of sight, shape (..., 3).
        roughness_rad: Standard deviation of the surface's slopes, doubled by the mirror.
    """
    total = np.zeros(places_mm.shape[:-1], dtype=np.float32)
    for lamp in light.lamps:
        to_lamp = lamp.place_mm.astype(np.float32) - places_mm
        distance = np.sqrt(dot(to_lamp, to_lamp))
        cosine = dot(to_lamp, mirrored) / np.maximum(distance, 1.0)
        angle_squared = 2 * np.maximum(1 - cosine, 0)  # small angles; both ends are harmless
        size = (lamp.radius_mm / np.maximum(distance, lamp.radius_mm)) ** 2 / 4
        spread = roughness_rad**2 + size
        peak = lamp.brightness * PAINT_ROUGHNESS_RAD**2 / spread
        total += np.asarray(peak * np.exp(-angle_squared / (2 * spread)), dtype=np.float32)
    return total
