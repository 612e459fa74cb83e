"""The one protocol of motion boards: real ones and the simulated one."""

from __future__ import annotations

from collections.abc import AsyncIterator, Sequence
from dataclasses import dataclass
from enum import IntEnum
from typing import Protocol

from drivers.robot.state import RobotState
from twin.motion.segments import Segment


class StopCategory(IntEnum):
    """Stop categories of IEC 60204-1 that firmware can perform.

    Category 0 (power cut at once) needs a hard-wired emergency stop.
    """

    DECELERATE_AND_RELEASE = 1
    DECELERATE_AND_HOLD = 2


@dataclass(frozen=True, slots=True)
class RobotIdentity:
    """What answered on the link.

    Attributes:
        name: Name a person recognises, such as "Simulator" or "Me Auriga".
        firmware: Version of its firmware.
        queue_capacity: Segments the board can hold.
        segment_s: Duration of a segment that the board is made for [s].
    """

    name: str
    firmware: str
    queue_capacity: int
    segment_s: float


class RobotDriver(Protocol):
    """A motion board. All times are event loop times; every call raises RobotDriverError.

    The driver keeps the link alive by itself (heartbeats, reconnection). Telemetry comes at
    100 Hz while the robot moves and at 10 Hz or more at rest, and it never stops while the link
    lives: a silence of more than 0.3 s means that the link is gone.
    """

    async def connect(self) -> RobotIdentity:
        """Open the link and wait until the board has identified itself."""
        ...

    async def close(self) -> None:
        """Stop the motion (category 1) and close the link. Safe to call twice."""
        ...

    def telemetry(self) -> AsyncIterator[RobotState]:
        """Every sample from now on; ends when the link is lost or closed."""
        ...

    async def enable(self) -> None:
        """Energise the drives."""
        ...

    async def disable(self) -> None:
        """De-energise the drives; refused while moving."""
        ...

    async def home(self) -> None:
        """Seek the limit switches and set the positions; returns when done."""
        ...

    async def set_force_limit(self, force_n: float) -> None:
        """Cap the force of the rho3 actuator [N]; the board enforces it by itself."""
        ...

    async def push(self, segments: Sequence[Segment]) -> None:
        """Append segments to the board's queue; all or none.

        The first segment must begin where the queue ends. A board whose queue runs empty while
        the last segment still had velocity decelerates and latches QUEUE_UNDERRUN.

        Raises:
            QueueFullError: they do not fit.
            BoardRefusedError: they are discontinuous, beyond limits, or the board is not READY
                or RUN.
        """
        ...

    async def stop(self, category: StopCategory) -> None:
        """Drop the queue and decelerate; honoured in every state, idempotent."""
        ...

    async def emergency_stop(self) -> None:
        """Category 1 stop, then latch EMERGENCY_STOP."""
        ...

    async def clear_fault(self) -> None:
        """Release a latched fault whose cause is gone."""
        ...
