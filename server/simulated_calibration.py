"""A badly built robot of chance, calibrated from end to end on the simulator in virtual time."""

from __future__ import annotations

import asyncio
import time
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drivers.simulator.parameters import BuildErrors
from drivers.simulator.truth import tip_at_rest
from drivers.simulator.world import SimulatedWorld
from server.composition import running
from server.config.settings import Settings
from server.control.built_robot import BuiltRobot
from server.schema.calibrations import CalibrationDetail
from server.schema.routines import BeltReading, RoutineRequest
from server.services import Services
from server.simulation import park_first
from server.timing import VirtualTimeLoop
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import gamma

Array = NDArray[np.float64]

TECHNICIAN = "Simulated technician"
RULE_MM = 300.0
RULE_SIGMA_MM = 0.1
_GRID, _DEPTHS = 7, 3


@dataclass(frozen=True, slots=True, eq=False)
class SimulatedCalibration:
    """What became of one robot, as its simulated world really is.

    Attributes:
        seed: Of the garage.
        before_mm: How far the plug's tip misses places all over the regular box, as built.
        after_mm: The same calibrated; None if the routine did not succeed.
        found: The calibration; None if there is none.
        poses: From how many the robot looked.
        trouble: Why the routine did not succeed; "" if it did.
        wall_s: Computing time.
    """

    seed: int
    before_mm: Array
    after_mm: Array | None
    found: CalibrationDetail | None
    poses: int
    trouble: str
    wall_s: float


def simulate_calibration(settings: Settings) -> SimulatedCalibration:
    """Build a robot by chance of the seed, calibrate it, and look at how it really is."""
    parameters = settings.simulation.parameters.model_copy(
        update={"build": before_calibration(settings.simulation.parameters.build)}
    )
    simulation = settings.simulation.model_copy(update={"parameters": parameters})
    with asyncio.Runner(loop_factory=VirtualTimeLoop) as runner:
        return runner.run(_simulate(settings.model_copy(update={"simulation": simulation})))


def before_calibration(build: BuildErrors) -> BuildErrors:
    """What a drill, a printer and a cheap lens leave; the sag as it is chosen."""
    return BuildErrors.before_calibration().model_copy(update={"sag_scale": build.sag_scale})


def tip_errors_mm(world: SimulatedWorld, geometry: RobotGeometry, built: BuiltRobot) -> Array:
    """How far the plug's tip really is from where it is sent, all over the regular box.

    Places are shifted and turned as suits best (Kabsch 1976): where in the room the base frame
    lies is a choice, and each socket is measured in it.

    Args:
        world: Knows the truth.
        geometry: The robot as drawn.
        built: What is known of the built one.

    Returns:
        Shape (n,) [mm].
    """
    wanted = _box(geometry)
    joints = gamma.inverse_many(geometry, wanted)
    if built.correction is not None:
        joints = built.correction.to_board_many(joints)
    there = np.array([tip_at_rest(world.plant, JointPosition(*row)) for row in joints.tolist()])
    return fitted_distance_mm(there, wanted)


def fitted_distance_mm(there: Array, wanted: Array) -> Array:
    """Distances of points, shape (n, 3), after the rigid motion that suits best, shape (n,)."""
    a, b = there - there.mean(axis=0), wanted - wanted.mean(axis=0)
    left, _, right = np.linalg.svd(a.T @ b)
    proper = np.diag([1.0, 1.0, np.linalg.det(right.T @ left.T)])
    return np.asarray(np.linalg.norm(a @ (right.T @ proper @ left.T).T - b, axis=1))


def _box(geometry: RobotGeometry) -> Array:
    """Tips all over the regular box, shape (n, 3), the depth in the middle of the slide's way."""
    box, slide = geometry.regular_box, geometry.rho3
    dy_mm, z_mm = gamma.tip_offset(geometry, 0.5 * (slide.min_mm + slide.max_mm))
    axes = [
        centre + np.linspace(-0.5, 0.5, count) * width
        for centre, width, count in (
            (box.center_x_mm, box.width_mm, _GRID),
            (box.center_y_mm + dy_mm, box.height_mm, _GRID),
            (z_mm, box.depth_mm, _DEPTHS),
        )
    ]
    return np.stack(np.meshgrid(*axes), axis=-1).reshape(-1, 3)


async def _simulate(settings: Settings) -> SimulatedCalibration:
    began = time.perf_counter()
    async with running(settings, folder=None) as services:
        garage = services.garage
        assert garage is not None  # noqa: S101 - the drivers are the simulator's
        await park_first(services)
        supervisor = services.supervisor
        before = tip_errors_mm(garage.world, settings.geometry, supervisor.built)
        await services.routines.begin(
            technicians_request(garage.world, settings.simulation.seed), TECHNICIAN
        )
        await services.routines.wait()
        routine = services.routines.shown
        assert routine is not None  # noqa: S101 - it was begun a moment ago
        found = await _put_in_force(services, routine.calibration_id)
        after = tip_errors_mm(garage.world, settings.geometry, supervisor.built)
    return SimulatedCalibration(
        seed=settings.simulation.seed,
        before_mm=before,
        after_mm=after if found else None,
        found=found,
        poses=routine.done,
        trouble=routine.problem.detail if routine.problem else "",
        wall_s=time.perf_counter() - began,
    )


async def _put_in_force(services: Services, calibration_id: str | None) -> CalibrationDetail | None:
    if calibration_id is None:
        return None
    await services.calibrations.activate(calibration_id, by=TECHNICIAN, accept_worse=False)
    return await services.calibrations.get(calibration_id)


def technicians_request(world: SimulatedWorld, seed: int) -> RoutineRequest:
    """What a technician with a rule and a calliper says."""
    rng = np.random.default_rng((seed, len(TECHNICIAN)))
    left, right = (
        BeltReading(
            commanded_mm=RULE_MM,
            measured_mm=RULE_MM * scale + float(np.sqrt(2) * rng.normal(0.0, RULE_SIGMA_MM)),
            reading_sigma_mm=RULE_SIGMA_MM,
        )
        for scale in (world.plant.mechanism.left_scale, world.plant.mechanism.right_scale)
    )
    return RoutineRequest(left_belt=left, right_belt=right, label_sigma_mm=0.1)
