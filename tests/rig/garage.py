"""The simulated garage around a board in the rig.

The garage's own robot stays unused: its joints follow the true positions of the rig's motors, and
what the plug meets comes back as a load on the rig's screw.
"""

from __future__ import annotations

from typing import Protocol

from drivers.camera import CameraModel
from drivers.simulator.following import FollowedMotors, without_motors
from drivers.simulator.garage import SimulatedGarage, build_garage
from drivers.simulator.parameters import SimulationParameters
from tests.rig.control import Control
from tests.rig.machine import Machine, true_joints
from tests.rig.truth import TrueState
from twin.camera_mount import CameraMount
from twin.motion import MotionLimits

LOAD_SPACING_MM = 0.05
LOAD_PLACES = range(-8, 9)
"""Where the load on the screw is worked out ahead, as multiples of the spacing: the rig looks it up
by itself until the next sample."""


class Board(Protocol):
    """A running board and what hangs on it."""

    @property
    def control(self) -> Control:
        """Truth and faults."""
        ...

    @property
    def machine(self) -> Machine:
        """What hangs on it."""
        ...


class GarageAroundRig:
    """Couples a garage to a rig, sample by sample.

    Args:
        rig: A running board.
        optics: Of the camera.
        parameters: Numbers of the garage.
        seed: Decides everything random in it.

    Attributes:
        garage: The garage; use its camera and its station.
    """

    def __init__(
        self, rig: Board, optics: CameraModel, parameters: SimulationParameters, seed: int
    ) -> None:
        self._rig = rig
        self._loaded = False
        self.garage: SimulatedGarage = build_garage(
            rig.machine.geometry,
            MotionLimits(),
            CameraMount(),
            optics,
            without_motors(parameters, rig.machine.start),
            seed=seed,
        )
        self._motors = FollowedMotors(self.garage.world)
        rig.control.on_sample(self._follow)

    def _follow(self, sample: TrueState) -> None:
        self._motors.move(true_joints(self._rig.machine, sample), sample.at_s)
        self._load_screw()

    def _load_screw(self) -> None:
        rho3_mm = self._motors.position.rho3_mm
        places_mm = [rho3_mm + LOAD_SPACING_MM * place for place in LOAD_PLACES]
        forces_n = self.garage.world.contact_forces_n(places_mm)
        loaded = any(forces_n)
        if loaded or self._loaded:
            self._rig.control.load_soon(places_mm[0], LOAD_SPACING_MM, forces_n)
        self._loaded = loaded
