"""How fast and how exact the kinematics and the motion planning are.

Run with: python -m tests.bench.kinematics
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable

import numpy as np

from twin.geometry import RobotGeometry
from twin.joints import JointPosition, TipPosition
from twin.kinematics import forward, forward_many, inverse, inverse_many, jacobian, singularity
from twin.motion import (
    MotionLimits,
    check_plan,
    plan_joint_move,
    plan_segments,
    plan_stop,
    plan_straight_line,
)

REPEATS = 31
POSES = 10_000
GEOMETRY = RobotGeometry()
LIMITS = MotionLimits()


def timed_us(call: Callable[[], object], inner: int = 1) -> tuple[float, float]:
    """Median and 95th percentile over REPEATS of the mean time of one call [us]."""
    call()
    times: list[float] = []
    for _ in range(REPEATS):
        began = time.perf_counter()
        for _ in range(inner):
            call()
        times.append((time.perf_counter() - began) / inner * 1e6)
    return statistics.median(times), statistics.quantiles(times, n=20)[-1]


def print_poses() -> None:
    """Scalar against vectorised functions, per pose."""
    rng = np.random.default_rng(1)
    tips = rng.uniform((560, 230, 215), (740, 390, 275), (POSES, 3))
    joints = inverse_many(GEOMETRY, tips)
    tip, pose = TipPosition(*tips[0].tolist()), JointPosition(*joints[0].tolist())
    rows: list[tuple[str, Callable[[], object], Callable[[], object] | None]] = [
        ("inverse", lambda: inverse(GEOMETRY, tip), lambda: inverse_many(GEOMETRY, tips)),
        ("forward", lambda: forward(GEOMETRY, pose), lambda: forward_many(GEOMETRY, joints)),
        (
            "singularity measures",
            lambda: singularity.measures(GEOMETRY, pose),
            lambda: singularity.measures_many(GEOMETRY, joints),
        ),
        ("jacobian", lambda: jacobian(GEOMETRY, pose), None),
    ]
    print(f"Per pose [us], {REPEATS} repeats, vectorised over {POSES} poses")
    print(f"{'':22}{'scalar':>9}{'p95':>9}{'calls/s':>11}{'vector':>9}{'p95':>9}{'faster':>9}")
    for name, scalar, vectorised in rows:
        one, one_p95 = timed_us(scalar, inner=1000)
        line = f"{name:22}{one:9.3f}{one_p95:9.3f}{1e6 / one:11.0f}"
        if vectorised is not None:
            many, many_p95 = (value / POSES for value in timed_us(vectorised))
            line += f"{many:9.4f}{many_p95:9.4f}{one / many:8.0f}x"
        print(line)
    error = np.abs(forward_many(GEOMETRY, joints) - tips)
    print(
        f"\nforward(inverse(tip)) - tip: median {np.median(error):.1e} mm, "
        f"p95 {np.quantile(error, 0.95):.1e} mm, largest {error.max():.1e} mm"
    )


def print_motion() -> None:
    """Planning, checking and discretising a long motion."""
    start, target = JointPosition(100, 100, 50), JointPosition(300, 200, 150)
    tip = forward(GEOMETRY, target)
    slow = plan_joint_move(LIMITS.scaled(0.7), start, target)
    line = plan_straight_line(GEOMETRY, LIMITS, start, tip)
    rows: list[tuple[str, Callable[[], object], int]] = [
        ("plan_joint_move", lambda: plan_joint_move(LIMITS, start, target), 100),
        ("plan_straight_line", lambda: plan_straight_line(GEOMETRY, LIMITS, start, tip), 10),
        ("plan_stop", lambda: plan_stop(LIMITS, slow.state_at(1.0)), 100),
        ("joint plan: state_at", lambda: slow.state_at(1.0), 1000),
        ("line plan: state_at", lambda: line.state_at(1.0), 1000),
        ("check_plan", lambda: check_plan(GEOMETRY, slow), 1),
        ("plan_segments", lambda: plan_segments(slow), 1),
    ]
    print(f"\nMotion [us]; check_plan and plan_segments on a plan of {slow.duration_s:.1f} s")
    print(f"{'':22}{'median':>9}{'p95':>9}")
    for name, call, inner in rows:
        median, p95 = timed_us(call, inner)
        print(f"{name:22}{median:9.1f}{p95:9.1f}")


if __name__ == "__main__":
    print_poses()
    print_motion()
