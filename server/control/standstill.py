"""After a protective stop the drives stay on, so somebody must watch that nothing moves."""

from __future__ import annotations

from drivers.robot import BoardState, RobotState
from server.config.supervision import SupervisionSettings
from server.control.board import MOVING
from twin.joints import JointPosition

AT_REST_MM_S = 1.0


class StandstillMonitor:
    """Sees that a stopped robot comes to rest in time and then stays where it is.

    Args:
        settings: In which time, and how far it may creep.
    """

    def __init__(self, settings: SupervisionSettings) -> None:
        self._settings = settings
        self._armed_s: float | None = None
        self._rest: JointPosition | None = None

    @property
    def at_rest(self) -> bool:
        """The stopped robot stands still."""
        return self._rest is not None

    def arm(self, now_s: float) -> None:
        """A stop was sent; once more does not begin a new time."""
        if self._armed_s is None:
            self._armed_s = now_s

    def disarm(self) -> None:
        """The stop was released."""
        self._armed_s = self._rest = None

    def check(self, state: RobotState) -> str | None:
        """Look at a sample.

        Returns:
            What is wrong, in words; None while all is well or no stop is in force.
        """
        if self._armed_s is None or state.sampled_at_s < self._armed_s:
            return None
        if state.board is BoardState.FAULT or not state.enabled:
            self._rest = state.measured.position  # the board itself keeps the drives from moving
            return None
        position = state.measured.position
        if self._rest is None:
            moves = max(abs(v) for v in state.measured.velocity) >= AT_REST_MM_S
            if not moves and state.board not in MOVING:
                self._rest = position
            elif state.sampled_at_s - self._armed_s > self._settings.stopping_s:
                limit_s = self._settings.stopping_s
                return f"The robot still moves {limit_s:g} s after it was stopped."
            return None
        crept_mm = max(abs(a - b) for a, b in zip(position, self._rest, strict=True))
        if crept_mm > self._settings.standstill_mm:
            return f"The stopped robot has moved by {crept_mm:.1f} mm."
        return None
