"""Simulated jobs as text: JSON for programs, tables for people."""

from __future__ import annotations

import json
from collections.abc import Sequence

from server.simulation import SimulatedJob


def as_document(outcome: SimulatedJob) -> str:
    """One JSON object on one line."""
    result = outcome.job.result
    return json.dumps(
        {
            "seed": outcome.seed,
            "succeeded": outcome.succeeded,
            "state": outcome.job.state.value,
            "lateral_error_mm": _rounded(outcome.lateral_error_mm, 4),
            "insertion_depth_mm": _rounded(outcome.insertion_depth_mm, 3),
            "max_force_n": round(outcome.max_force_n, 2),
            "duration_s": round(outcome.duration_s, 3),
            "limit_duration_s": outcome.limit_duration_s,
            "divergences": outcome.divergences,
            "phases": [
                {
                    "phase": phase.phase,
                    "started_s": round(phase.started_s, 3),
                    "duration_s": round(phase.duration_s, 3),
                }
                for phase in outcome.phases
            ],
            "measured": result.model_dump(mode="json"),
            "error": outcome.job.error.model_dump(mode="json") if outcome.job.error else None,
            "wall_s": round(outcome.wall_s, 3),
        }
    )


def as_table(outcome: SimulatedJob) -> str:
    """The phases with their times, and the result in words."""
    lines = [f"{'phase':<14}{'at':>9}{'took':>9}"]
    lines += [
        f"{phase.phase:<14}{phase.started_s:>7.2f} s{phase.duration_s:>7.2f} s"
        for phase in outcome.phases
    ]
    lines += ["", *_result_lines(outcome)]
    return "\n".join(lines)


def as_line(outcome: SimulatedJob) -> str:
    """One line of a campaign."""
    if not outcome.succeeded or outcome.lateral_error_mm is None:
        reason = outcome.job.error.detail if outcome.job.error else outcome.job.state.value
        return f"seed {outcome.seed:>4}  FAILED  {reason}"
    return (
        f"seed {outcome.seed:>4}  lateral {outcome.lateral_error_mm:.3f} mm"
        f"  depth {outcome.insertion_depth_mm or 0:.2f} mm"
        f"  force {outcome.max_force_n:.1f} N"
        f"  {outcome.duration_s:.2f} s = {_ratio(outcome):.2f} x limit"
        f"  computed in {outcome.wall_s:.1f} s"
        + "".join(f"\n{'':>11}{found}" for found in outcome.divergences)
    )


def as_summary(outcomes: Sequence[SimulatedJob]) -> str:
    """Median, 95th percentile and worst of a campaign."""
    good = [outcome for outcome in outcomes if outcome.succeeded]
    lines = ["", f"{len(good)} of {len(outcomes)} succeeded"]
    if not good:
        return "\n".join(lines)
    parted = sum(bool(outcome.divergences) for outcome in outcomes)
    lines.append(f"robot and model parted in {parted} of them")
    lines.append(f"{'':<24}{'median':>9}{'p95':>9}{'worst':>9}")
    for name, unit, values in (
        ("lateral error", "mm", [o.lateral_error_mm or 0.0 for o in good]),
        ("depth off 40 mm", "mm", [abs((o.insertion_depth_mm or 0.0) - 40.0) for o in good]),
        ("largest force", "N", [o.max_force_n for o in good]),
        ("accepted to seated", "s", [o.duration_s for o in good]),
        ("over the limit", "x", [_ratio(o) for o in good]),
        ("computing", "s", [o.wall_s for o in good]),
    ):
        ordered = sorted(values)
        figures = (_quantile(ordered, 0.5), _quantile(ordered, 0.95), ordered[-1])
        label = f"{name} [{unit}]"
        lines.append(f"{label:<24}" + "".join(f"{figure:>9.3f}" for figure in figures))
    return "\n".join(lines)


def _result_lines(outcome: SimulatedJob) -> list[str]:
    job = outcome.job
    lines = []
    if outcome.lateral_error_mm is not None and outcome.insertion_depth_mm is not None:
        lines += [
            f"Plugged in after {outcome.duration_s:.2f} s, "
            f"{_ratio(outcome):.2f} times what the joint limits alone allow.",
            f"The plug met the socket {outcome.lateral_error_mm:.3f} mm off its centre and is "
            f"{outcome.insertion_depth_mm:.2f} mm deep; largest force {outcome.max_force_n:.1f} N.",
        ]
    lines += outcome.divergences
    if job.error is not None:
        lines.append(f"{job.error.title}: {job.error.detail} {job.error.remedy}")
    else:
        lines.append(f"The job {job.state.value}.")
    return [*lines, f"Computed in {outcome.wall_s:.2f} s."]


def _ratio(outcome: SimulatedJob) -> float:
    limit_s = outcome.limit_duration_s
    return outcome.duration_s / limit_s if limit_s else float("nan")


def _quantile(ordered: Sequence[float], share: float) -> float:
    return ordered[min(len(ordered) - 1, round(share * (len(ordered) - 1)))]


def _rounded(value: float | None, digits: int) -> float | None:
    return None if value is None else round(value, digits)
