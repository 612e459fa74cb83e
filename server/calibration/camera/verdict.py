"""Is this calibration good enough for half a millimetre?

The limits follow from what errors of the camera do to the socket's place (at 130 and 450 mm): a
principal point that is off by 1 px shifts it by 0.1 and 0.3 mm; a focal length that is off by 0.1 %
moves it by 0.15 and 0.5 mm in depth.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from server.calibration.camera.coverage import covered_share, uncovered_edges
from server.calibration.camera.solve import CameraSolution
from server.calibration.grade import Grade, worst

GOOD_RMS_PX, USABLE_RMS_PX = 0.4, 1.0
GOOD_FOCAL_SHARE, USABLE_FOCAL_SHARE = 0.001, 0.003
GOOD_CENTRE_PX, USABLE_CENTRE_PX = 0.5, 2.0
GOOD_COVER, USABLE_COVER = 0.8, 0.6
TILTED_RAD = math.radians(15.0)
FEWEST_TILTED = 4
OVERFIT = 1.5


@dataclass(frozen=True, slots=True)
class Verdict:
    """The grade, and what keeps it from being better.

    Attributes:
        grade: Worst of all criteria.
        remarks: One sentence for each criterion that is not good, with what to do.
    """

    grade: Grade
    remarks: tuple[str, ...]


def judge(solution: CameraSolution, coverage: NDArray[np.int_]) -> Verdict:
    """Judge a calibration by its residuals, its certainty and its coverage."""
    camera, sigma = solution.camera, solution.sigma
    focal_share = max(sigma["fx"] / camera.fx, sigma["fy"] / camera.fy)
    centre_px = max(sigma["cx"], sigma["cy"])
    cover = covered_share(coverage)
    marks: list[tuple[Grade, str]] = [
        (
            _grade(solution.rms_px, GOOD_RMS_PX, USABLE_RMS_PX),
            f"The corners are {solution.rms_px:.2f} px off on average: is the board flat, the "
            "focus fixed, and nothing blurred?",
        ),
        (
            _grade(focal_share, GOOD_FOCAL_SHARE, USABLE_FOCAL_SHARE),
            f"The focal length is sure to {100 * focal_share:.2f} % only: take more pictures at an "
            "angle and at different distances.",
        ),
        (
            _grade(centre_px, GOOD_CENTRE_PX, USABLE_CENTRE_PX),
            f"The centre is sure to {centre_px:.1f} px only: turn the board (or the camera) by 90 "
            "degrees in some pictures, and tilt it.",
        ),
        (
            _grade(-cover, -GOOD_COVER, -USABLE_COVER),
            f"The board has been in {100 * cover:.0f} % of the picture: move it to where it was "
            "not" + _edges(coverage) + ".",
        ),
    ]
    tilted = sum(view.used and view.tilt_rad > TILTED_RAD for view in solution.views)
    if tilted < FEWEST_TILTED:
        text = f"Only {tilted} pictures show the board at an angle; take {FEWEST_TILTED} or more."
        marks.append((Grade.USABLE, text))
    if solution.check_px > OVERFIT * solution.rms_px and solution.check_px > GOOD_RMS_PX:
        text = (
            f"Pictures that were held back fit worse ({solution.check_px:.2f} px): take more "
            "pictures."
        )
        marks.append((Grade.USABLE, text))
    left_out = sum(not view.used for view in solution.views)
    if 3 * left_out > len(solution.views):
        text = f"{left_out} pictures had to be left out: did the board bend or the focus move?"
        marks.append((Grade.BAD, text))
    grade = worst(grade for grade, _ in marks)
    return Verdict(grade, tuple(text for grade, text in marks if grade is not Grade.GOOD))


def _grade(value: float, good: float, usable: float) -> Grade:
    if value <= good:
        return Grade.GOOD
    return Grade.USABLE if value <= usable else Grade.BAD


def _edges(coverage: NDArray[np.int_]) -> str:
    edges = uncovered_edges(coverage)
    return f", above all to the {', '.join(edges)} edge" if edges else ""
