"""The simulated garage around a board in the rig.

The garage's own robot stays unused: its joints follow the true positions of the rig's motors, and
what the plug meets comes back as a load on the rig's screw.
"""

from __future__ import annotations

from drivers.camera import CameraModel
from drivers.simulator.garage import SimulatedGarage, build_garage
from drivers.simulator.parameters import SimulationParameters
from tests.rig.control import TrueState
from tests.rig.machine import true_joints
from tests.rig.rig import Rig
from twin.camera_mount import CameraMount
from twin.joints import JointAcceleration, JointPosition, JointVelocity
from twin.motion import MotionLimits
from twin.motion.segments import Segment

NO_LAG_S = 1e-6
"""The rig has its own motors: the garage's must not add a lag."""

NO_LIMIT_N = 1e5
"""Nor a limit of force."""

LOAD_SPACING_MM = 0.05
LOAD_PLACES = range(-8, 9)
"""Where the load on the screw is worked out ahead, as multiples of the spacing: the rig looks it up
by itself until the next sample."""

UNACCELERATED = JointAcceleration(0.0, 0.0, 0.0)


def garage_parameters(
    parameters: SimulationParameters, start: JointPosition
) -> SimulationParameters:
    """Parameters of a garage whose motors are elsewhere and stand where the rig's do."""
    return parameters.model_copy(
        update={
            "drives": parameters.drives.model_copy(update={"lag_s": NO_LAG_S}),
            "homing": parameters.homing.model_copy(update={"power_off_creep_std_mm": 0.0}),
            "board": parameters.board.model_copy(update={"start_joints": start}),
        }
    )


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
        self, rig: Rig, optics: CameraModel, parameters: SimulationParameters, seed: int
    ) -> None:
        self._rig = rig
        self._position = rig.machine.start
        self._loaded = False
        self.garage: SimulatedGarage = build_garage(
            rig.machine.geometry,
            MotionLimits(),
            CameraMount(),
            optics,
            garage_parameters(parameters, self._position),
            seed=seed,
        )
        self.garage.world.set_force_limit(NO_LIMIT_N, 0.0)
        rig.control.on_sample(self._follow)

    def _follow(self, sample: TrueState) -> None:
        world = self.garage.world
        before = world.advance(0.0)
        elapsed_s = sample.at_s - before.t_s
        if elapsed_s <= 0:
            return  # somebody has asked the world about a later time; the next sample makes up
        position = true_joints(self._rig.machine, sample)
        if position != self._position:
            velocity = JointVelocity(
                *((q - p) / elapsed_s for q, p in zip(position, self._position, strict=True))
            )
            segment = Segment(elapsed_s, self._position, velocity, UNACCELERATED)
            world.follow([segment], before.t_s)
            self._position = position
        world.advance(sample.at_s)
        self._load_screw()

    def _load_screw(self) -> None:
        places_mm = [self._position.rho3_mm + LOAD_SPACING_MM * place for place in LOAD_PLACES]
        forces_n = self.garage.world.contact_forces_n(places_mm)
        loaded = any(forces_n)
        if loaded or self._loaded:
            self._rig.control.load_soon(places_mm[0], LOAD_SPACING_MM, forces_n)
        self._loaded = loaded
