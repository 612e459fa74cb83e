"""Moves the simulated car for whoever tries PlugPilot out."""

from __future__ import annotations

import asyncio
import math

from drivers.simulator.traffic import Arrival, CarWouldHitError, NoCarUnderWayError, Traffic
from drivers.simulator.world import CarIsPluggedInError, SimulatedWorld
from server.errors import PlugPilotError
from server.schema.simulation import Brake, CarCommand, DriveIn, DriveOn, Leave, SimulatedCarNow


class CarRefusesError(PlugPilotError):
    """The simulated driver does not do that."""

    code = "car_refuses"
    title = "The simulated car cannot do that"
    status = 409
    remedy = "Unplug it first, let it drive in first, or choose a shorter way."


class SimulatedCar:
    """The one simulated car.

    Args:
        world: The garage.
    """

    def __init__(self, world: SimulatedWorld) -> None:
        self.traffic = Traffic(world)
        self._world = world

    @property
    def now(self) -> SimulatedCarNow:
        """Where it really is."""
        now_s = asyncio.get_running_loop().time()
        x, y, z = (round(float(v), 2) for v in self._world.spot.at(now_s).T_base_socket[:3, 3])
        moving = self._world.spot.moving
        state = moving.state_at(now_s) if moving is not None else None
        return SimulatedCarNow(
            x_mm=x,
            y_mm=y,
            z_mm=z,
            speed_mm_s=round(state.speed_mm_s, 1) if state is not None else 0.0,
            moving=moving is not None and state is not None and not moving.rests(state),
        )

    def carry_out(self, command: CarCommand) -> SimulatedCarNow:
        """Tell the driver what to do.

        Raises:
            CarRefusesError: that is not possible.
        """
        now_s = asyncio.get_running_loop().time()
        try:
            self._tell(command, now_s)
        except (CarIsPluggedInError, CarWouldHitError, NoCarUnderWayError) as error:
            text = str(error)
            raise CarRefusesError(f"{text[0].upper()}{text[1:]}.") from error
        return self.now

    def _tell(self, command: CarCommand, now_s: float) -> None:
        traffic = self.traffic
        match command:
            case DriveIn():
                traffic.arrive(
                    Arrival(
                        from_mm=command.from_mm,
                        right_mm=command.right_mm,
                        heading_rad=math.radians(command.heading_deg),
                        past_mm=command.past_mm,
                        aims_right_mm=command.aims_right_mm,
                    ),
                    now_s,
                )
            case DriveOn(steer_right_mm=None):
                traffic.creep(command.forward_mm, now_s)
            case DriveOn():
                traffic.steer_in(command.forward_mm, now_s, right_mm=command.steer_right_mm or 0.0)
            case Brake():
                traffic.brake(now_s)
            case Leave():
                traffic.leave(now_s)
