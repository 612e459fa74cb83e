"""Limits of the motion along a path that keep every joint within its own limits.

With the distance s(t) on the path and the joints q(s),

    qdot   = q' sdot
    qddot  = q' sddot + q'' sdot^2
    qdddot = q' sdddot + 3 q'' sdot sddot + q''' sdot^3.

So with the largest magnitudes of q', q'', q''' on the path, limits V, A, J of the motion along it
are safe if for every joint

    |q'| V <= v,   |q'| A + |q''| V^2 <= a,   |q'| J + 3 |q''| V A + |q'''| V^3 <= j.

A curved path asks for a compromise: a lower V leaves more for A and J. Where the joints follow
the path in proportion the compromise vanishes and the joints' own limits come out.
"""

from __future__ import annotations

import numpy as np

from twin.motion.errors import PlanningError
from twin.motion.limits import MotionLimits
from twin.motion.plan import Array
from twin.motion.tip_line import PathDerivatives
from twin.motion.trajectory import AxisLimits

LARGEST = 1e6
"""Stands for "no limit" where a joint hardly moves along the path [mm, s]."""

GRID = 20
ROUNDS = 3
SHRINK = 0.2
"""The compromise is searched on a grid of V and A, then on grids SHRINK times as wide."""


def path_limits(
    limits: MotionLimits,
    derivatives: PathDerivatives,
    length_mm: float,
    largest_speed_mm_s: float = LARGEST,
) -> AxisLimits:
    """Safe limits along a path, chosen for the shortest motion from rest to rest.

    Args:
        limits: Limits of the joints.
        derivatives: Largest magnitudes of the joints' derivatives on the path.
        length_mm: Length of the path [mm].
        largest_speed_mm_s: Limit of the speed along the path [mm/s].

    Raises:
        PlanningError: a joint would have to be infinitely fast.
    """
    if not np.isfinite(derivatives).all():
        msg = "on this line a leg would stand perpendicular to the rail, where no speed is possible"
        raise PlanningError(msg)
    # joints in the last axis, so that they broadcast against any grid of candidates
    slope, curve, twist = (np.array(order) for order in derivatives)
    v = np.array([joint.velocity_mm_s for joint in limits.joints])
    a = np.array([joint.acceleration_mm_s2 for joint in limits.joints])
    j = np.array([joint.jerk_mm_s3 for joint in limits.joints])

    def least_ratio(room: Array) -> Array:
        """What the joints leave for the path, by their room for it; at most LARGEST."""
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = np.where(slope > 0, room / slope, LARGEST)
        smallest: Array = np.minimum(ratio.min(axis=-1), LARGEST)
        return smallest

    best = AxisLimits(0.0, 0.0, 0.0)
    best_time_s = np.inf
    top_speed = min(float(least_ratio(v)), largest_speed_mm_s)
    # V as a share of its limit, A as a share of what V leaves for it
    share_v, share_a, width = 1.0, 1.0, 1.0
    for _ in range(ROUNDS):
        shares_v, shares_a = np.meshgrid(_shares(share_v, width), _shares(share_a, width))
        speed = top_speed * shares_v
        by_joint = speed[..., np.newaxis]
        acceleration = shares_a * least_ratio(a - curve * by_joint**2)
        used = 3 * curve * by_joint * acceleration[..., np.newaxis] + twist * by_joint**3
        jerk = least_ratio(j - used)
        time_s = rest_to_rest_time_s(length_mm, speed, acceleration, jerk)
        at = np.unravel_index(np.argmin(time_s), time_s.shape)
        if time_s[at] < best_time_s:
            best_time_s = time_s[at]
            best = AxisLimits(float(speed[at]), float(acceleration[at]), float(jerk[at]))
            share_v, share_a = float(shares_v[at]), float(shares_a[at])
        width *= SHRINK
    return best


def _shares(centre: float, width: float) -> Array:
    """Shares in (0, 1] around a centre, its upper end included."""
    high = min(centre + 0.5 * width, 1.0)
    low = max(high - width, 0.0)
    return np.linspace(high, low, GRID, endpoint=False)


def rest_to_rest_time_s(
    length_mm: float, velocity_mm_s: Array, acceleration_mm_s2: Array, jerk_mm_s3: Array
) -> Array:
    """Shortest time from rest to rest over a distance, for many limits; infinite for unusable ones.

    The seven phases of a jerk-limited motion, of which some vanish:

    - the distance is too short for the velocity and the acceleration limit: T = 4 (S / 2J)^(1/3);
    - too short for the velocity limit: T = 2 (p/A + A/J) with the peak velocity p from
      p^2/A + p A/J = S;
    - otherwise T = S/V + r with the ramp time r = V/A + A/J, or r = 2 sqrt(V/J) where the
      acceleration limit is not reached.
    """
    usable = (velocity_mm_s > 0) & (acceleration_mm_s2 > 0) & (jerk_mm_s3 > 0)
    v = np.where(usable, velocity_mm_s, 1.0)
    j = np.where(usable, jerk_mm_s3, 1.0)
    # an acceleration that no ramp reaches before V is no limit: lower it to the one reached
    a = np.minimum(np.where(usable, acceleration_mm_s2, 1.0), np.sqrt(v * j))
    ramp_s = v / a + a / j
    peak = 0.5 * (np.sqrt(a**4 / j**2 + 4 * a * length_mm) - a * a / j)
    time_s = np.select(
        [length_mm >= v * ramp_s, length_mm >= 2 * a**3 / j**2],
        [length_mm / v + ramp_s, 2 * (peak / a + a / j)],
        4 * np.cbrt(length_mm / (2 * j)),
    )
    return np.where(usable, time_s, np.inf)
