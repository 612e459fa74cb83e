"""Does the solution deserve to be used? Judged by looks that were held back.

The looks are parted into groups; each group is predicted by the solution of the others. A robot
whose mechanism is known better predicts them better, and whoever only follows the noise does not.
The same looks are predicted by the calibration that is in use now, with camera and label fitted
anew, so that both are judged alike.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from server.calibration.grade import Grade, worst
from server.calibration.robot.errors import RobotFitDivergedError
from server.calibration.robot.known_before import KnownBefore
from server.calibration.robot.looks import LabelLook
from server.calibration.robot.solve import FITS, RobotSolution, solve_robot
from server.calibration.robot.tip_doubt import TipDoubt, tip_doubt
from server.calibration.robot.unknowns import NAMES, WORDS, Unknowns
from twin.as_built import PlanarAsBuilt
from twin.geometry import RobotGeometry

Array = NDArray[np.float64]

GROUPS = 5
GOOD_MM, USABLE_MM = 0.06, 0.15
"""Root mean square error across the picture of looks that were held back."""
GOOD_TIP_MM, USABLE_TIP_MM = 0.2, 1.0
"""What the tip may miss in 95 % of the box, in 95 of 100 cases."""
MOST_OUTLIERS = 0.2
LABEL_RATIOS = (0.995, 1.005)
"""True size of a label over the entered one, at most."""
_ANY_RHO_MM = 200.0
PRIOR_SIGMAS = 4.0
"""An unknown so far from the drawing is rather a mistake than a bad build."""


@dataclass(frozen=True, slots=True)
class RobotVerdict:
    """The grade, its reasons, and before and after.

    Attributes:
        grade: Worst of all criteria.
        remarks: One sentence for each criterion that is not good, with what to do.
        held_back_mm: Error of held-back looks with the new calibration, root mean square.
        in_use_mm: The same with the one in use now.
        tip: What the plug's tip may still miss, all over the box.
    """

    grade: Grade
    remarks: tuple[str, ...]
    held_back_mm: float
    in_use_mm: float
    tip: TipDoubt

    @property
    def makes_worse(self) -> bool:
        """The one in use now predicts the looks better."""
        return self.held_back_mm > self.in_use_mm


def judge(
    solution: RobotSolution,
    looks: Sequence[LabelLook],
    known: KnownBefore,
    in_use: PlanarAsBuilt,
) -> RobotVerdict:
    """Judge a solution.

    Args:
        solution: Of all looks.
        looks: These.
        known: What was known beforehand.
        in_use: The mechanism that is believed now.
    """
    unknowns = solution.unknowns
    held_back_mm = _held_back_mm(looks, unknowns.drawn, unknowns.R_base_camera_drawn, known)
    in_use_mm = mechanism_error_mm(in_use, unknowns.R_base_camera, looks)
    marks: list[tuple[Grade, str]] = []
    if held_back_mm > USABLE_MM:
        marks.append(
            (
                Grade.BAD,
                f"Places that were held back are missed by {held_back_mm:.2f} mm: did the label "
                "move, is a belt loose, does a carriage stick?",
            )
        )
    elif held_back_mm > GOOD_MM:
        marks.append(
            (
                Grade.USABLE,
                f"Places that were held back are missed by {held_back_mm:.2f} mm; a good robot "
                f"manages {GOOD_MM:g} mm. Tighten the belts and repeat.",
            )
        )
    if held_back_mm > in_use_mm:
        marks.append(
            (
                Grade.BAD,
                f"The calibration in use misses the same places by {in_use_mm:.2f} mm only; this "
                f"one by {held_back_mm:.2f} mm.",
            )
        )
    outliers = float(np.mean(solution.weight < FITS))
    if outliers > MOST_OUTLIERS:
        marks.append(
            (
                Grade.BAD,
                f"{100 * outliers:.0f} % of the looks do not fit to the others: something moved "
                "during the routine.",
            )
        )
    tip = tip_doubt(solution)
    if tip.at_most_mm > GOOD_TIP_MM:
        marks.append(
            (
                Grade.USABLE if tip.at_most_mm <= USABLE_TIP_MM else Grade.BAD,
                f"At the edges of the workspace the plug may still be {tip.at_most_mm:.2f} mm off: "
                "measure the belts over 400 mm and the label with a calliper, let the label be "
                "near the middle of the workspace, and repeat.",
            )
        )
    marks += [(Grade.USABLE, text) for text in _far_from_the_drawing(solution, known)]
    grade = worst(grade for grade, _ in marks)
    remarks = tuple(text for _, text in marks)
    return RobotVerdict(grade, remarks, held_back_mm, in_use_mm, tip)


def _held_back_mm(
    looks: Sequence[LabelLook],
    drawn: RobotGeometry,
    R_base_camera_drawn: Array,
    known: KnownBefore,
) -> float:
    squares: list[float] = []
    for group in range(GROUPS):
        rest = [look for number, look in enumerate(looks) if number % GROUPS != group]
        held = looks[group::GROUPS]
        try:
            fitted = solve_robot(rest, drawn, R_base_camera_drawn, known)
        except RobotFitDivergedError:
            return np.inf
        squares += np.sum(fitted.residual_of(held)[:, :2] ** 2, axis=1).tolist()
    return float(np.sqrt(np.mean(squares)))


def mechanism_error_mm(
    built: PlanarAsBuilt, R_base_camera: Array, looks: Sequence[LabelLook]
) -> float:
    """Error of a mechanism that is not solved for; camera and label suit it best.

    The best rigid motion between where the mechanism has the platform and where the looks have it
    (Kabsch 1976), and the label as large as suits best; in depth nothing moves.

    Args:
        built: The mechanism.
        R_base_camera: How the camera is turned, shape (3, 3).
        looks: At one label.
    """
    by_mechanism = built.forward_many(np.stack([look.rho_mm for look in looks]))
    seen = np.stack([look.label_mm for look in looks])
    by_looks = -(seen @ R_base_camera.T)[:, :2]
    here, there = by_mechanism - by_mechanism.mean(axis=0), by_looks - by_looks.mean(axis=0)
    left, _, right = np.linalg.svd(there.T @ here)
    turn = right.T @ np.diag([1.0, np.linalg.det(right.T @ left.T)]) @ left.T
    turned = there @ turn.T
    ratio = float(np.clip(np.sum(here * turned) / np.sum(turned**2), *LABEL_RATIOS))
    off = here - ratio * turned
    return float(np.sqrt(np.mean(np.sum(off**2, axis=1))))


def _far_from_the_drawing(solution: RobotSolution, known: KnownBefore) -> list[str]:
    values = solution.unknowns.values
    drawn = Unknowns.guess(
        solution.unknowns.drawn,
        solution.unknowns.R_base_camera_drawn,
        np.zeros(2) + _ANY_RHO_MM,
        np.zeros(3),
    ).values
    drawn[NAMES.index("left_scale")], drawn[NAMES.index("right_scale")] = known.scales
    found = []
    for name, value, before, sigma in zip(NAMES, values, drawn, known.sigma, strict=True):
        if np.isfinite(sigma) and abs(value - before) > PRIOR_SIGMAS * sigma:
            found.append(
                f"{WORDS[name]} differs from the drawing by {_in_words(name, value - before)}: "
                "measure it by hand before you trust this."
            )
    return found


def _in_words(name: str, difference: float) -> str:
    if name.endswith("_mm"):
        return f"{difference:+.1f} mm"
    if name.endswith("_rad"):
        return f"{np.degrees(difference):+.2f} degrees"
    return f"{100 * difference:+.2f} %"
