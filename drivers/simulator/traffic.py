"""Tells the simulated car's driver what to do: come, stop, creep on, leave."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from drivers.simulator.moving_car import CarState, MovingCar
from drivers.simulator.world import SimulatedWorld

LEAVES_BY_MM = 6_000.0
KEEPS_AWAY_MM = 8.0
"""From the plug in its place; nobody drives into it on purpose."""


class CarWouldHitError(RuntimeError):
    """The car would run into the plug."""


class NoCarUnderWayError(RuntimeError):
    """There is no car that could be told so."""


@dataclass(frozen=True, slots=True)
class Arrival:
    """How a car comes in. Left and right are the driver's; right is the way x grows.

    Attributes:
        from_mm: How far before its place it begins, standing.
        right_mm: How far beside its way the socket is then.
        heading_rad: How it is turned then, positive to the left.
        past_mm: Where the driver stops unless told: beyond the place, negative short of it.
        aims_right_mm: How far beside the right line the driver aims.
    """

    from_mm: float = 3_500.0
    right_mm: float = 0.0
    heading_rad: float = 0.0
    past_mm: float = 0.0
    aims_right_mm: float = 0.0


class Traffic:
    """Cars that come and go in one simulated garage.

    The place of a car is where the world has parked it; an arrival brings it there, or as near
    as its driver manages.

    Args:
        world: The garage.
    """

    def __init__(self, world: SimulatedWorld) -> None:
        self._world = world
        self._arrivals = 0

    @property
    def under_way(self) -> MovingCar | None:
        """The car that was driven in, while it is there."""
        return self._world.spot.moving

    def arrive(self, arrival: Arrival, now_s: float) -> MovingCar:
        """Bring the car of this garage in from outside.

        Raises:
            CarIsPluggedInError: the plug is in its socket.
            CarWouldHitError: it would run into the plug.
        """
        world = self._world
        place = world.spot.place[:3, 3]
        self._require_room(float(place[2]) - arrival.past_mm)
        numbers = world.parameters.driving
        psi = arrival.heading_rad
        axle_x = place[0] + arrival.right_mm + numbers.nose_mm * math.sin(psi)
        axle_z = place[2] + arrival.from_mm + numbers.nose_mm * math.cos(psi)
        self._arrivals += 1
        car = MovingCar(
            numbers,
            np.array(place),
            CarState(now_s, float(axle_x), float(axle_z), psi),
            line_x_mm=float(place[0]) + arrival.aims_right_mm,
            phase=1.7 * self._arrivals,
        )
        world.let_drive(car, now_s)
        car.go(now_s, arrival.from_mm + arrival.past_mm, steer=True)
        return car

    def brake(self, now_s: float) -> None:
        """The driver stops now.

        Raises:
            NoCarUnderWayError: there is no driver.
        """
        self._require().brake(now_s)

    def creep(self, forward_mm: float, now_s: float) -> None:
        """The driver goes on so far, back if negative, the wheels straight.

        Raises:
            NoCarUnderWayError: there is no driver.
            CarIsPluggedInError: the plug is in the socket.
            CarWouldHitError: the car would run into the plug.
        """
        car = self._require()
        self._require_room(float(self._world.spot.at(now_s).T_base_socket[2, 3]) - forward_mm)
        self._world.let_drive(car, now_s)
        car.go(now_s, forward_mm, steer=False)

    def steer_in(self, forward_mm: float, now_s: float, *, right_mm: float = 0.0) -> None:
        """The driver goes on so far and aims beside the line as told.

        Raises:
            NoCarUnderWayError, CarIsPluggedInError, CarWouldHitError: as in ``creep``.
        """
        car = self._require()
        self._require_room(float(self._world.spot.at(now_s).T_base_socket[2, 3]) - forward_mm)
        self._world.let_drive(car, now_s)
        car.aim_beside(right_mm)
        car.go(now_s, forward_mm, steer=True)

    def leave(self, now_s: float) -> None:
        """The car backs out of the garage.

        Raises:
            CarIsPluggedInError: the plug is in its socket.
        """
        world = self._world
        car = world.spot.moving
        if car is None:
            place = world.spot.place[:3, 3]
            axle_z = float(place[2]) + world.parameters.driving.nose_mm
            start = CarState(now_s, float(place[0]), axle_z, 0.0)
            car = MovingCar(
                world.parameters.driving, np.array(place), start, float(place[0]), phase=0.0
            )
        world.let_drive(car, now_s)
        car.go(now_s, -LEAVES_BY_MM, steer=False)

    def _require(self) -> MovingCar:
        car = self._world.spot.moving
        if car is None:
            raise NoCarUnderWayError("no car has driven in: let one arrive first")
        return car

    def _require_room(self, face_z_mm: float) -> None:
        tip_mm = float(self._world.truth().T_base_plug[2, 3])
        if face_z_mm < tip_mm + KEEPS_AWAY_MM:
            raise CarWouldHitError(
                f"the socket would come to {face_z_mm:.0f} mm from the wall, but the plug stands "
                f"out {tip_mm:.0f} mm"
            )
