"""What force a good insertion takes at each depth, and how sure that is."""

from __future__ import annotations

import math
from bisect import bisect_right

from twin.divergence.findings import Quantity, Residual
from twin.divergence.numbers import Curve, ForceNumbers
from twin.divergence.samples import Entry, Sample


def on_curve(curve: Curve, depth_mm: float) -> float:
    """Linear between the points of a curve, constant outside."""
    index = bisect_right([point[0] for point in curve], depth_mm)
    if index == 0:
        return curve[0][1]
    if index == len(curve):
        return curve[-1][1]
    (x0, y0), (x1, y1) = curve[index - 1], curve[index]
    return y0 + (y1 - y0) * (depth_mm - x0) / (x1 - x0)


class InsertionForce:
    """Compares the slide's force with that of a good insertion or withdrawal.

    Going in at depth d the model expects F(d) = peak * engagement(d) + friction. Its standard
    deviation has four independent parts: the spread of good sockets, proportional to the contact
    force; the uncertain depth, as a quarter of what the curve spans within two standard
    deviations of depth, which is right at kinks too; the slide's friction; the noise of a sample.

    Coming out only a pull that is too strong counts: contacts that let go more easily, or that
    still relax, are no fault.

    Args:
        numbers: Curves and spreads.
    """

    def __init__(self, numbers: ForceNumbers) -> None:
        self._numbers = numbers

    def compare(self, sample: Sample, entry: Entry | None) -> Residual | None:
        """One comparison; None while the slide stands, when its force says nothing.

        Args:
            sample: The robot.
            entry: Where the socket begins; None for a plug that moves freely.
        """
        depth_mm = -math.inf if entry is None else sample.measured.rho3_mm - entry.face_rho3_mm
        face_sigma_mm = 0.0 if entry is None else entry.sigma_mm
        return self.judge(depth_mm, sample.velocity.rho3_mm_s, sample.force_n, face_sigma_mm)

    def judge(
        self, depth_mm: float, speed_mm_s: float, force_n: float, face_sigma_mm: float
    ) -> Residual | None:
        """The same comparison with plain numbers.

        Args:
            depth_mm: Plug tip behind the socket's face.
            speed_mm_s: Of the slide's set point, positive towards the car.
            force_n: Measured.
            face_sigma_mm: Standard deviation of the face's place.
        """
        n = self._numbers
        if abs(speed_mm_s) < n.slowest_mm_s:
            return None
        going_in = speed_mm_s > 0
        depth_sigma_mm = math.hypot(n.depth_sigma_mm, face_sigma_mm)
        contact_n, sigma_n = self.expected(depth_mm, depth_sigma_mm, going_in=going_in)
        if going_in:
            return Residual(Quantity.FORCE, contact_n + n.friction_n, force_n, sigma_n, unit="N")
        strongest_n = -contact_n - n.friction_n
        return Residual(Quantity.FORCE, strongest_n, min(force_n, strongest_n), sigma_n, unit="N")

    def expected(
        self, depth_mm: float, depth_sigma_mm: float, *, going_in: bool
    ) -> tuple[float, float]:
        """Size of the contact force and the standard deviation of a measured force [N]."""
        n = self._numbers
        curve = n.engagement if going_in else n.withdrawal
        if depth_mm < -4 * depth_sigma_mm:
            return 0.0, math.hypot(n.friction_sigma_n, n.noise_n)
        contact_n = n.peak_n * on_curve(curve, depth_mm)
        low_mm, high_mm = depth_mm - 2 * depth_sigma_mm, depth_mm + 2 * depth_sigma_mm
        inside = [share for depth, share in curve if low_mm < depth < high_mm]
        around = [on_curve(curve, low_mm), on_curve(curve, high_mm), *inside]
        sigma_n = math.hypot(
            n.peak_sigma * contact_n,
            n.peak_n * (max(around) - min(around)) / 4,
            n.friction_sigma_n,
            n.noise_n,
        )
        return contact_n, sigma_n
