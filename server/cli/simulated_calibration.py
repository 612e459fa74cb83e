"""Simulated calibrations as text: JSON for programs, tables for people."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from server.simulated_calibration import Array, SimulatedCalibration

_SHARES = (50, 95, 100)
_TIP_MM, _JOB_MM = 0.15, 0.10
_NUMBERS = 7


def as_document(outcome: SimulatedCalibration) -> dict[str, Any]:
    """What is kept of one robot."""
    found = outcome.found
    return {
        "seed": outcome.seed,
        "poses": outcome.poses,
        "before_mm": _figures(outcome.before_mm),
        "after_mm": None if outcome.after_mm is None else _figures(outcome.after_mm),
        "lateral_mm": None if outcome.lateral_mm is None else round(outcome.lateral_mm, 4),
        "grade": found.grade.value if found else None,
        "held_back_mm": found.error if found else None,
        "in_use_mm": found.error_in_use if found else None,
        "inside": outcome.inside,
        "jointly": outcome.jointly,
        "tip_at_most_mm": found.evidence.tip_at_most_mm if found and found.evidence else None,
        "robot_s": found.evidence.duration_s if found and found.evidence else None,
        "trouble": outcome.trouble,
        "wall_s": round(outcome.wall_s, 2),
    }


def as_line(document: dict[str, Any]) -> str:
    """One robot of a campaign."""
    before, after = document["before_mm"], document["after_mm"]
    if after is None or document["lateral_mm"] is None:
        return f"seed {document['seed']:>4}  FAILED  {document['trouble']}"
    return (
        f"seed {document['seed']:>4}  before {before[1]:.3f} mm  after {after[1]:.3f} mm"
        f"  job {document['lateral_mm']:.3f} mm off"
        f"  {document['poses']} poses in {document['robot_s']:.0f} s, {document['grade']}"
        f"  computed in {document['wall_s']:.1f} s"
    )


def as_table(outcome: SimulatedCalibration) -> str:
    """One robot before and after, in words."""
    lines = [
        "How far the plug's tip misses places of the regular box, shifted and turned as suits best",
        f"{'':<10}{'median':>11}{'p95':>11}{'worst':>11}",
        _row("before", _figures(outcome.before_mm)),
    ]
    if outcome.after_mm is None or outcome.found is None:
        return "\n".join([*lines, "", outcome.trouble or "The routine did not succeed."])
    found, evidence = outcome.found, outcome.found.evidence
    lines.append(_row("after", _figures(outcome.after_mm)))
    lines += [
        "",
        f"{outcome.poses} poses"
        + (f" in {evidence.duration_s:.0f} s of robot time; " if evidence else "; ")
        + f"places held back are missed by {found.error or 0:.3f} mm, as drawn by "
        f"{found.error_in_use or 0:.3f} mm: {found.grade.value}.",
        *found.remarks,
        *(evidence.unseen if evidence else []),
        _job(outcome),
        f"Computed in {outcome.wall_s:.1f} s.",
    ]
    return "\n".join(lines)


def _job(outcome: SimulatedCalibration) -> str:
    if outcome.lateral_mm is None:
        return f"The socket was not taught, or the job failed: {outcome.trouble}"
    return (
        "The socket was taught by hand, the car came again, and the plug of a whole job met the "
        f"socket {outcome.lateral_mm:.3f} mm beside its centre."
    )


def as_summary(documents: Sequence[dict[str, Any]]) -> str:
    """All robots of a campaign together."""
    good = [one for one in documents if one["lateral_mm"] is not None]
    lines = ["", f"{len(good)} of {len(documents)} robots were calibrated, taught, and plugged in"]
    if not good:
        return "\n".join(lines)
    lines.append(f"{'':<26}{'median':>9}{'p95':>9}{'worst':>9}")
    for name, values, wanted in (
        ("tip before, p95 [mm]", [one["before_mm"][1] for one in good], ""),
        ("tip after, p95 [mm]", [one["after_mm"][1] for one in good], "0.15"),
        ("job at the socket [mm]", [one["lateral_mm"] for one in good], "0.10"),
        ("robot time [s]", [one["robot_s"] for one in good], "180"),
        ("poses", [one["poses"] for one in good], "25"),
    ):
        median, p95, worst = np.percentile(values, _SHARES).tolist()
        lines.append(f"{name:<26}{median:>9.3f}{p95:>9.3f}{worst:>9.3f}   {wanted}".rstrip())
    after, before = (np.array([one[key][1] for one in good]) for key in ("after_mm", "before_mm"))
    lateral = np.array([one["lateral_mm"] for one in good])
    at_most = np.array([one["tip_at_most_mm"] for one in good])
    numbers = sum(one["inside"] for one in good) / (_NUMBERS * len(good))
    for name, share, wanted in (
        ("tip within 0.15 mm", float(np.mean(after <= _TIP_MM)), "95 %"),
        ("job within 0.10 mm", float(np.mean(lateral <= _JOB_MM)), "95 %"),
        ("better than before", float(np.mean(after < before)), "100 %"),
        ("true numbers in stated 95 %", numbers, "91 to 99 %"),
        ("all of a robot together", float(np.mean([one["jointly"] for one in good])), "91 to 99 %"),
        ("tip no more off than stated", float(np.mean(after <= at_most)), "95 % or more"),
    ):
        lines.append(f"{name:<30}{100 * share:>6.1f} %   {wanted}")
    return "\n".join(lines)


def kept_documents(file: Path | None) -> dict[int, dict[str, Any]]:
    """What an earlier run of the campaign has kept, by seed.

    Those of an older release, with other figures, are left out: they are computed anew.
    """
    if file is None or not file.exists():
        return {}
    documents = [json.loads(line) for line in file.read_text(encoding="utf-8").splitlines()]
    return {document["seed"]: document for document in documents if "jointly" in document}


def _row(name: str, figures: Sequence[float]) -> str:
    return f"{name:<10}" + "".join(f"{figure:>8.3f} mm" for figure in figures)


def _figures(errors_mm: Array) -> list[float]:
    """Median, 95th percentile and worst."""
    return [round(value, 4) for value in np.percentile(errors_mm, _SHARES).tolist()]
