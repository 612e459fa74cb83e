"""The results as a table in Markdown."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from server.vision.projection import Array
from tests.bench.vision.scores import Scores

HEAD = (
    "| set | mm | method | found | lateral mm | depth mm | depth bias mm | tilt deg | in 95% "
    "| ms |\n|---|---|---|---|---|---|---|---|---|---|"
)


def row(name: str, distance: str, method: str, scores: Scores) -> str:
    """One line: share found; median / 95th percentile / worst; bias; honesty; time."""
    bias = scores.depth_bias_mm
    honest = scores.honest_share
    cells = (
        name,
        distance,
        method,
        f"{len(scores.errors)}/{scores.asked}",
        _three(scores.lateral_mm, 4),
        _three(scores.depth_mm, 4),
        "" if bias is None else f"{bias[0]:+.4f} ± {bias[1]:.4f}",
        _three(scores.tilt_deg, 3),
        "" if honest is None else f"{honest:.1%}",
        f"{scores.median_ms:.1f}",
    )
    return f"| {' | '.join(cells)} |"


def _three(values: Array, digits: int) -> str:
    if not len(values):
        return ""
    middle, high, worst = np.percentile(values, (50, 95, 100))
    return f"{middle:.{digits}f} / {high:.{digits}f} / {worst:.{digits}f}"


def document(rows: Iterable[str], frames: int) -> str:
    """The whole page."""
    about = (
        f"{frames} frames per set, 1280 x 720, one thread; times are processor time. Errors are "
        "median / 95th percentile / worst of the poses found. The depth bias is the mean of the "
        'signed errors with its standard error. "In 95%" is the share of true errors inside the '
        "stated 95% ellipsoid of all six numbers."
    )
    return "\n".join(("# Locating the label", "", about, "", HEAD, *rows, ""))
