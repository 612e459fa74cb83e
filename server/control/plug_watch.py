"""Judges every sample of a motion of the plug in its socket: force, depth, stall, lag.

A peak alone says too little: 30 N are nothing at the bottom of a socket and a bent contact at its
mouth, and no force at all where the contacts should rub means that there is no socket.
"""

from __future__ import annotations

import math
from collections import deque

from drivers.robot import RobotState
from server.config.supervision import SupervisionSettings
from server.control.errors import (
    FollowingError,
    ForceAboveBandError,
    ForceBelowBandError,
    ForceLimitError,
    SlideStalledError,
)
from server.control.force_curve import SAMPLES, ForceCurve
from twin.force_band import ForceBand
from twin.slide_pace import SlidePace

TOLD_MM = 0.3
"""A set point that went so far within the stall time told the slide to move."""

FOLLOWS = 0.5
"""Share of the set point's way that a slide makes which follows it."""

MOVED_MM = 0.05
"""A slide that went less has not moved: a few counts of its encoder."""


class PlugWatch:
    """Watches one motion along the insertion axis; ``check`` is a ``Watch``.

    Args:
        settings: Tolerances of stall and lag.
        limit_n: Largest force in either direction.
        face_rho3_mm: rho3 at which the tip is level with the socket's face; None when nobody
            knows, and then only the limit counts.
        band: Forces that are good at each depth.

    Attributes:
        curve: What was measured.
        began_rho3_mm: Where the motion began; None before the first sample.
    """

    def __init__(
        self,
        settings: SupervisionSettings,
        *,
        limit_n: float,
        face_rho3_mm: float | None = None,
        band: ForceBand | None = None,
    ) -> None:
        self.curve = ForceCurve()
        self.began_rho3_mm: float | None = None
        self._settings = settings
        self._limit_n = limit_n
        self._face_rho3_mm = face_rho3_mm
        self._band = band
        self._recent: deque[RobotState] = deque()
        self._window: deque[RobotState] = deque(maxlen=SAMPLES)
        self._pace = SlidePace()

    def check(self, state: RobotState) -> None:
        """Take in a sample.

        Raises:
            ForceLimitError: the force is over its limit.
            ForceAboveBandError: it is more than is good at this depth.
            ForceBelowBandError: it is less: the plug is not in the socket.
            SlideStalledError: the slide is told to move and does not.
            FollowingError: it lags too far behind.
        """
        rho3_mm = state.measured.position.rho3_mm
        if self.began_rho3_mm is None:
            self.began_rho3_mm = rho3_mm
        commanded = state.commanded
        speed_mm_s = commanded.velocity.rho3_mm_s
        self._window.append(state)
        self._pace.take(state.sampled_at_s, commanded.position.rho3_mm, speed_mm_s, rho3_mm)
        point = self.curve.add(rho3_mm - (self._face_rho3_mm or 0.0), state.force_n)
        if point is not None:
            self._judge_force(*point, moves_in=speed_mm_s > 0)
        self._judge_slide(state)

    def _judge_force(self, depth_mm: float, force_n: float, *, moves_in: bool) -> None:
        facts = {"force_n": round(force_n, 1)}
        if self._face_rho3_mm is not None:
            facts["depth_mm"] = round(depth_mm, 1)
        if abs(force_n) > self._limit_n:
            verb = "Pushing" if force_n > 0 else "Pulling"
            raise ForceLimitError(
                f"{verb} took {abs(force_n):.0f} N; the limit is {self._limit_n:.0f} N.",
                **facts,
                limit_n=self._limit_n,
            )
        if self._band is None or self._face_rho3_mm is None or depth_mm < 0 or self._stands():
            return
        lower_n, upper_n = self._band.at(depth_mm)
        over, under = force_n > upper_n, force_n < lower_n
        too_much, too_little = (over, under) if moves_in else (under, over)
        if too_much and self._pace.shows_too_much:
            allowed_n = upper_n if over else lower_n
            raise ForceAboveBandError(
                f"At a depth of {depth_mm:.1f} mm the plug met {abs(force_n):.0f} N; "
                f"{abs(allowed_n):.0f} N are allowed there.",
                **facts,
                limit_n=round(abs(allowed_n), 1),
            )
        if too_little and moves_in and self._pace.shows_too_little:
            raise ForceBelowBandError(
                f"At a depth of {depth_mm:.1f} mm the plug met only {force_n:.0f} N; "
                f"a socket gives {lower_n:.0f} N or more there.",
                **facts,
                limit_n=round(lower_n, 1),
            )

    def _stands(self) -> bool:
        """The slide is told to move, and is not seen to.

        One that stands against a force is the board's business. It knows whether the slide was
        seen to push itself tight, or whether its encoder may be dead and the position is lost.
        """
        first, last = self._window[0], self._window[-1]
        told_mm = last.commanded.position.rho3_mm - first.commanded.position.rho3_mm
        moved_mm = last.measured.position.rho3_mm - first.measured.position.rho3_mm
        return abs(moved_mm) < FOLLOWS * abs(told_mm)

    def _judge_slide(self, state: RobotState) -> None:
        lag_mm = abs(state.commanded.position.rho3_mm - state.measured.position.rho3_mm)
        if lag_mm > self._settings.following_error_mm:
            raise FollowingError(
                f"The slide is {lag_mm:.1f} mm behind its set point at {state.force_n:.0f} N.",
                lag_mm=round(lag_mm, 2),
                force_n=round(state.force_n, 1),
            )
        self._recent.append(state)
        before = self._recent[0]
        if state.sampled_at_s - before.sampled_at_s < self._settings.stall_s:
            return
        self._recent.popleft()
        told_mm = state.commanded.position.rho3_mm - before.commanded.position.rho3_mm
        moved_mm = state.measured.position.rho3_mm - before.measured.position.rho3_mm
        if abs(told_mm) >= TOLD_MM and math.copysign(1.0, told_mm) * moved_mm < MOVED_MM:
            raise SlideStalledError(
                f"The slide pushes with {abs(state.force_n):.0f} N and does not move."
                if told_mm > 0
                else f"The slide pulls with {abs(state.force_n):.0f} N and does not move.",
                force_n=round(state.force_n, 1),
                rho3_mm=round(state.measured.position.rho3_mm, 2),
            )
