"""A badly built robot of chance, calibrated from end to end on the simulator in virtual time."""

from __future__ import annotations

import asyncio
import time
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drivers.simulator.parameters import BuildErrors
from drivers.simulator.truth import mechanism_from_below, tip_from_below
from drivers.simulator.world import SimulatedWorld
from server.calibration.robot.known_before import KnownBefore
from server.calibration.robot.solve import solve_robot
from server.calibration.robot.unknowns import MECHANISM, NAMES, mechanism_values
from server.calibration.routines.known import known_before
from server.calibration.versions.comparing import look_of
from server.composition import running
from server.config.settings import Settings
from server.control.built_robot import BuiltRobot
from server.errors import InternalError, PlugPilotError
from server.jobs.model import JobState, JobType
from server.schema.calibrations import CalibrationDetail, RobotValues
from server.schema.jobs import JobRequest
from server.schema.routines import Routine, RoutineRequest, SocketRoutineRequest
from server.services import Services
from server.simulated_technician import SimulatedTechnician
from server.simulation import park_first
from server.timing import VirtualTimeLoop
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import gamma

Array = NDArray[np.float64]

TECHNICIAN = "Simulated technician"
SURELY = 1.96
"""Standard deviations that hold 95 % of true values."""
CHI_SQUARED_7 = 14.067
"""Squared whitened length that holds 95 % of true sets of seven."""
PARKS_WITHIN_MM = 20.0
"""How far beside the taught place the car stands when it comes again."""
PLAY_MM = 0.3
"""Of each axis, in the routines and in the job: what belts and screws of a poor robot have."""
_GRID, _DEPTHS = 7, 3


@dataclass(frozen=True, slots=True, eq=False)
class SimulatedCalibration:
    """What became of one robot, as its simulated world really is.

    Attributes:
        seed: Of the garage.
        before_mm: How far the plug's tip misses places all over the regular box, as built.
        after_mm: The same calibrated; None if the routine did not succeed.
        lateral_mm: How far beside its centre the plug of a whole job then meets the socket; None if
            that did not succeed.
        found: The calibration; None if there is none.
        inside: How many of the seven numbers of the mechanism lie within the stated 95 %.
        jointly: All seven together lie within the stated 95 %.
        poses: From how many the robot looked.
        trouble: What did not succeed; "" if all did.
        wall_s: Computing time.
    """

    seed: int
    before_mm: Array
    after_mm: Array | None
    lateral_mm: float | None
    found: CalibrationDetail | None
    inside: int | None
    jointly: bool | None
    poses: int
    trouble: str
    wall_s: float


def simulate_calibration(settings: Settings) -> SimulatedCalibration:
    """Build a robot by chance of the seed, calibrate it, and look at how it really is."""
    usual = settings.simulation.parameters
    parameters = usual.model_copy(
        update={
            "build": before_calibration(usual.build),
            "drives": usual.drives.model_copy(update={"backlash_mm": (PLAY_MM,) * 3}),
        }
    )
    simulation = settings.simulation.model_copy(update={"parameters": parameters})
    with asyncio.Runner(loop_factory=VirtualTimeLoop) as runner:
        return runner.run(_simulate(settings.model_copy(update={"simulation": simulation})))


def before_calibration(build: BuildErrors) -> BuildErrors:
    """What a drill, a printer and a cheap lens leave; the sag as it is chosen."""
    return BuildErrors.before_calibration().model_copy(update={"sag_scale": build.sag_scale})


def tip_errors_mm(world: SimulatedWorld, geometry: RobotGeometry, built: BuiltRobot) -> Array:
    """How far the plug's tip really is from where it is sent, all over the regular box.

    Every place is approached from below, as the routines do, so that play is the same everywhere.
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
    zero, play_mm = world.surroundings.zero, world.parameters.drives.backlash_mm
    there = np.array(
        [tip_from_below(world.plant, JointPosition(*row), zero, play_mm) for row in joints.tolist()]
    )
    return fitted_distance_mm(there, wanted)


def numbers_inside(world: SimulatedWorld, geometry: RobotGeometry, found: CalibrationDetail) -> int:
    """How many true numbers of the mechanism lie within 1.96 stated standard deviations."""
    if not isinstance(found.values, RobotValues) or found.evidence is None:
        raise InternalError("This is no calibration of a robot.")
    play_mm = world.parameters.drives.backlash_mm
    built = mechanism_from_below(world.plant, world.surroundings.zero, play_mm)
    off = mechanism_values(found.values.mechanism, geometry) - mechanism_values(built, geometry)
    sigma = np.array([found.evidence.sigma[name] for name in NAMES[MECHANISM]])
    return int(np.sum(np.abs(off) < SURELY * sigma))


def jointly_inside(
    world: SimulatedWorld, settings: Settings, found: CalibrationDetail, known: KnownBefore
) -> bool:
    """Whether the true mechanism lies in the ellipsoid that holds it in 95 of 100 cases.

    Its covariance is not kept: the looks are solved once more.
    """
    if found.evidence is None:
        raise InternalError("This is no calibration of a robot.")
    drawn = settings.geometry
    looks = [look_of(record) for record in found.evidence.looks]
    solution = solve_robot(looks, drawn, settings.camera.mount.T_platform_camera[:3, :3], known)
    play_mm = world.parameters.drives.backlash_mm
    built = mechanism_from_below(world.plant, world.surroundings.zero, play_mm)
    off = mechanism_values(solution.unknowns.built, drawn) - mechanism_values(built, drawn)
    surprise = off @ np.linalg.solve(solution.covariance[MECHANISM, MECHANISM], off)
    return float(surprise) < CHI_SQUARED_7


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
        rng = np.random.default_rng((settings.simulation.seed, len(TECHNICIAN)))
        technician = SimulatedTechnician(services, garage.world, rng)
        supervisor = services.supervisor
        await park_first(services)
        before = tip_errors_mm(garage.world, settings.geometry, supervisor.built)
        camera = technician.camera_calibration(garage.camera.optics, TECHNICIAN)
        await _put_in_force(services, (await services.calibrations.keep(camera)).id)
        request = technician.request()
        known = known_before(request, garage.world.car.label_size_mm, None)
        routine = await _carried_out(services, request)
        after, found, lateral_mm, trouble = None, None, None, _trouble(routine)
        if routine.calibration_id is not None:
            found = await services.calibrations.get(routine.calibration_id)
            after = tip_errors_mm(garage.world, settings.geometry, supervisor.built)
            try:
                lateral_mm = await _taught_and_plugged_in(services, technician)
            except PlugPilotError as error:
                trouble = error.detail
    return SimulatedCalibration(
        seed=settings.simulation.seed,
        before_mm=before,
        after_mm=after,
        lateral_mm=lateral_mm,
        found=found,
        inside=numbers_inside(garage.world, settings.geometry, found) if found else None,
        jointly=jointly_inside(garage.world, settings, found, known) if found else None,
        poses=routine.done,
        trouble=trouble,
        wall_s=time.perf_counter() - began,
    )


async def _carried_out(services: Services, request: RoutineRequest) -> Routine:
    """Run a routine, and put what comes of it in force."""
    await services.routines.begin(request, TECHNICIAN)
    await services.routines.wait()
    routine = services.routines.shown
    assert routine is not None  # noqa: S101 - it was begun a moment ago
    if routine.calibration_id is not None:
        await _put_in_force(services, routine.calibration_id)
    return routine


async def _put_in_force(services: Services, calibration_id: str) -> None:
    await services.calibrations.activate(calibration_id, by=TECHNICIAN, accept_worse=False)


async def _taught_and_plugged_in(services: Services, technician: SimulatedTechnician) -> float:
    """Teach the socket, let the car come again, and plug in: by how much is the plug off?

    Raises:
        PlugPilotError: that did not work.
    """
    await technician.plug_in_by_hand()
    taught = await _carried_out(services, SocketRoutineRequest())
    if taught.calibration_id is None:
        raise InternalError(f"The socket was not taught: {_trouble(taught)}")
    await park_first(services)
    technician.park_elsewhere(PARKS_WITHIN_MM)
    job = await services.runner.create(JobRequest(type=JobType.PLUG_IN), key=None, digest=None)
    await services.runner.wait()
    ended = await services.jobs.get(job.id)
    if ended is None or ended.state is not JobState.SUCCEEDED:
        reason = ended.error.detail if ended and ended.error else "The job was lost."
        raise InternalError(f"The job did not succeed: {reason}")
    return technician.world.truth().lateral_error_mm


def _trouble(routine: Routine) -> str:
    return routine.problem.detail if routine.problem else ""
