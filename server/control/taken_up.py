"""On which side of their play the carriages rest, from what the board was told to do.

A belt with play lets its carriage stand anywhere within a gap behind the motor. After a motion
upwards by more than that gap the carriage rests at its lower end, and goes on doing so while the
motor only rises. Measured there and aimed at there, play is the same each time and drops out,
however wide it is. So the carriages come from below wherever the camera looks closely: in the
routines of the calibration, and before a socket.
"""

from __future__ import annotations

from drivers.robot import RobotState
from twin.geometry import RobotGeometry
from twin.joints import JointPosition

WIDEST_MM = 1.0
"""More than any play."""
RUN_UP_MM = 1.5
"""So far below a place the carriages turn: also as the built robot counts, more than any play."""
_WITHIN_MM = 0.02
"""A few steps of the motor."""


class TakenUp:
    """Follows both carriages as a gap of ``WIDEST_MM`` would let them: the play operator.

    Where the widest gap is taken up, every narrower one is. Nothing is known of carriages that
    somebody may have pushed, or that count anew.
    """

    def __init__(self) -> None:
        self._told_mm: tuple[float, float] | None = None
        self._taken_mm = (0.0, 0.0)

    @property
    def from_below(self) -> bool:
        """Both carriages are known to have come from below to where they are."""
        return self._told_mm is not None and min(self._taken_mm) >= WIDEST_MM - _WITHIN_MM

    def follow(self, board: RobotState) -> None:
        """Take in a sample, in the board's own joints."""
        if not (board.homed and board.enabled):
            self.forget()
            return
        told_mm = board.commanded.position[:2]
        if self._told_mm is not None:
            self._taken_mm = (
                _after(self._taken_mm[0], told_mm[0] - self._told_mm[0]),
                _after(self._taken_mm[1], told_mm[1] - self._told_mm[1]),
            )
        self._told_mm = told_mm

    def forget(self) -> None:
        """The link is down, or the carriages do not count as before."""
        self._told_mm, self._taken_mm = None, (0.0, 0.0)


def below(geometry: RobotGeometry, target: JointPosition) -> JointPosition:
    """Whence the carriages come to a target; at the end of their travel from as far as it goes."""
    return target._replace(
        rho1_mm=max(target.rho1_mm - RUN_UP_MM, min(target.rho1_mm, geometry.rho1.min_mm)),
        rho2_mm=max(target.rho2_mm - RUN_UP_MM, min(target.rho2_mm, geometry.rho2.min_mm)),
    )


def _after(taken_mm: float, moved_mm: float) -> float:
    return min(max(taken_mm + moved_mm, 0.0), WIDEST_MM)
