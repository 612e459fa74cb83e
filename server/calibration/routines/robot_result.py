"""From the looks to a version: solved, judged, and with what it rests on."""

from __future__ import annotations

from collections.abc import Sequence

from server.calibration.grade import Grade, worst
from server.calibration.robot.identifiability import combinations
from server.calibration.robot.known_before import KnownBefore
from server.calibration.robot.looks import LabelLook
from server.calibration.robot.moved_switch import moved_switch_mm
from server.calibration.robot.solve import RobotSolution, solve_robot
from server.calibration.robot.unknowns import NAMES, WORDS
from server.calibration.robot.verdict import judge
from server.calibration.routines.known import lens_is_measured
from server.calibration.routines.stand import Stand
from server.calibration.versions.comparing import records_of
from server.calibration.versions.new_calibration import NewCalibration
from server.calibration.versions.values import rotation_vector
from server.schema.calibrations import RobotEvidence, RobotValues
from twin.as_built import PlanarAsBuilt

LENS_UNKNOWN = (
    "The camera's own numbers are those of its data sheet, and jobs aim with them: calibrate the "
    "camera with the board, then repeat."
)


def result_of(
    looks: Sequence[LabelLook],
    stand: Stand,
    known: KnownBefore,
    *,
    made_by: str,
    duration_s: float,
    source: str,
) -> NewCalibration:
    """Solve for the robot and judge it beside the one in force.

    Raises:
        RobotCalibrationError: no robot near the drawing could have seen the label so.
    """
    drawn = stand.supervisor.geometry
    mount = stand.settings.camera.mount.T_platform_camera[:3, :3]
    correction = stand.supervisor.built.correction
    in_force = correction.built if correction else None
    solution = solve_robot(looks, drawn, mount, known)
    verdict = judge(solution, looks, known, in_force or PlanarAsBuilt.as_drawn(drawn))
    remarks = list(verdict.remarks)
    grade = verdict.grade
    switch = _moved_switch(looks, solution, in_force)
    if switch is not None:
        remarks.append(switch)
        grade = worst([grade, Grade.USABLE])
    if not lens_is_measured(stand):
        remarks.append(LENS_UNKNOWN)
        grade = worst([grade, Grade.USABLE])
    unknowns = solution.unknowns
    return NewCalibration(
        values=RobotValues(
            mechanism=unknowns.built,
            camera_rotation_rad=rotation_vector(unknowns.R_base_camera),
        ),
        made_by=made_by,
        source=source[:200],
        grade=grade,
        remarks=tuple(remarks),
        error=verdict.held_back_mm,
        error_in_use=verdict.in_use_mm,
        evidence=RobotEvidence(
            looks=records_of(looks, solution.residual_mm, solution.weight),
            sigma={name: solution.sigma_of(name) for name in NAMES},
            unseen=_unseen(solution, known),
            duration_s=duration_s,
            tip_likely_mm=verdict.tip.likely_mm,
            tip_at_most_mm=verdict.tip.at_most_mm,
        ),
    )


def _moved_switch(
    looks: Sequence[LabelLook], solution: RobotSolution, in_force: PlanarAsBuilt | None
) -> str | None:
    """Whether only a limit switch has moved since the calibration in force, in a sentence."""
    if in_force is None:
        return None
    by_mm = moved_switch_mm(looks, solution.unknowns.R_base_camera, in_force)
    if by_mm is None:
        return None
    return (
        f"The limit switches of the two carriages are {abs(by_mm):.1f} mm "
        f"{'further apart' if by_mm > 0 else 'nearer together'} than when the calibration in force "
        "was made: one of them has moved."
    )


def _unseen(solution: RobotSolution, known: KnownBefore) -> list[str]:
    """What was not seen, a sentence for each set of unknowns that go together."""
    groups = {
        tuple(sorted((name for name, _ in combination.parts), key=NAMES.index))
        for combination in combinations(solution.covariance, known)
        if not combination.seen
    }
    return [
        f"{_listed(group)}: the looks say little about that, and what was known before is kept."
        for group in sorted(groups)
    ]


def _listed(names: Sequence[str]) -> str:
    first, *others = (WORDS[name] for name in names)
    return " and ".join([first, *(words[0].lower() + words[1:] for words in others)])
