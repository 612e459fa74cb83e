"""How far each joint lags behind its set point."""

from __future__ import annotations

from drivers.robot import RobotState


class FollowingWatch:
    """Looks at every sample of a motion; pass ``take`` as its watch."""

    def __init__(self) -> None:
        self.largest_mm = [0.0, 0.0, 0.0]

    def take(self, state: RobotState) -> None:
        """Remember the largest distance of each joint."""
        both = zip(state.commanded.position, state.measured.position, strict=True)
        self.largest_mm = [
            max(before, abs(told - stands))
            for before, (told, stands) in zip(self.largest_mm, both, strict=True)
        ]
