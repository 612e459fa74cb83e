"""The place of the one car in the garage, and what is there at any time."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from drivers.simulator.car import ParkedCar
from drivers.simulator.moving_car import MovingCar
from drivers.simulator.view import Pose

_INSTANT_S = 0.002


class CarSpot:
    """Knows the car in its place, and whether it stands there, drives, or has left.

    Args:
        car: As it is parked.
    """

    def __init__(self, car: ParkedCar) -> None:
        self._car = car
        self._gone = False
        self._hidden = False
        self._moving: MovingCar | None = None

    @property
    def place(self) -> Pose:
        """T_base_socket of the car when it stands in its place."""
        return self._car.T_base_socket

    @property
    def moving(self) -> MovingCar | None:
        """The car as somebody drives it; None for one that has stood here all along."""
        return self._moving

    def at(self, t_s: float) -> ParkedCar:
        """The car at a time."""
        car = self._car
        if self._moving is not None:
            car = car.moved(self._moving.displacement_at(t_s))
        if self._gone:
            return car.driven_away()
        return car.without_label() if self._hidden else car

    def label_velocity_mm_s(self, t_s: float) -> NDArray[np.float64]:
        """Velocity of the label in the base frame, shape (3,)."""
        if self._moving is None:
            return np.zeros(3)
        before, after = (self.at(t_s + dt).T_base_label[:3, 3] for dt in (-_INSTANT_S, _INSTANT_S))
        return np.asarray((after - before) / (2 * _INSTANT_S))

    def park(self, car: ParkedCar) -> None:
        """Another car stands here, or the same one elsewhere."""
        self._car, self._gone, self._hidden, self._moving = car, False, False, None

    def vanish(self) -> None:
        """The car is gone, its label with it."""
        self._gone, self._moving = True, None

    def drive(self, moving: MovingCar) -> None:
        """The car is from now on where its driver brings it."""
        self._gone, self._moving = False, moving

    def stick_label(self, text: str) -> None:
        """Put a new label over the old one."""
        self._car = replace(self._car, payload=text)

    def cover_label(self, *, covered: bool) -> None:
        """Something covers the label, or no longer does."""
        self._hidden = covered
