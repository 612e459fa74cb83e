"""Segments in the board's own integers, past all planning: whatever the board accepts."""

from __future__ import annotations

import contextlib
from collections.abc import AsyncIterator, Iterator, Sequence
from dataclasses import dataclass

from drivers.arduino.connection import Connection, connect_board
from drivers.arduino.protocol import messages
from drivers.arduino.protocol.messages import State, Telemetry, TelemetryFlag
from drivers.robot import NotConnectedError
from tests.rig.rig import Rig
from tests.support.eventually import eventually
from twin.motion import MotionLimits

ANY_SPEED = MotionLimits().rho1.model_copy(update={"velocity_mm_s": 100.0})
WIDE_LIMITS = MotionLimits(rho1=ANY_SPEED, rho2=ANY_SPEED)
"""The board then accepts every rate of a carriage."""

ANY_JUMP_MM_S = 87.0
"""And every change of rate between two segments, also the one to rest."""


@dataclass(frozen=True, slots=True)
class RawBoard:
    """A homed board that takes bare segments.

    Attributes:
        rig: It runs in.
        connection: To it.
    """

    rig: Rig
    connection: Connection

    @property
    def newest(self) -> Telemetry:
        """The last sample that came."""
        return next(self._samples())

    @property
    def is_homed(self) -> bool:
        """Homing has ended well."""
        sample = self.newest
        return sample.state == State.READY and TelemetryFlag.HOMED in TelemetryFlag(sample.flags)

    async def follow(self, segments: Sequence[messages.Segment]) -> int:
        """Give the board a group of segments and wait until it has followed them.

        Returns:
            The tick at which the first segment began.
        """
        await self.connection.command(*segments)
        first, last = segments[0].number, segments[-1].number
        await eventually(lambda: self.newest.segment == (last + 1) % (1 << 16))
        return next(s.tick - s.segment_tick for s in self._samples() if s.segment == first)

    def _samples(self) -> Iterator[Telemetry]:
        """From the newest to the oldest."""
        for heard in reversed(self.rig.heard):
            if isinstance(heard.frame.message, Telemetry):
                yield heard.frame.message


@contextlib.asynccontextmanager
async def raw_board(rig: Rig) -> AsyncIterator[RawBoard]:
    """Connect to the board with wide limits, home it and let it go at the end."""
    lost: list[Exception] = []
    connection = await connect_board(
        "rig",
        open_line=rig.cable.open_line,
        settings=rig.machine.settings.model_copy(update={"velocity_tolerance_mm_s": ANY_JUMP_MM_S}),
        geometry=rig.machine.geometry,
        limits=WIDE_LIMITS,
        on_state=lambda _: None,
        on_lost=lost.append,
    )
    board = RawBoard(rig, connection)
    await connection.command(messages.Enable())
    await connection.home()
    await eventually(lambda: board.is_homed, within_s=60.0)
    yield board
    assert not lost
    await connection.close(NotConnectedError("The test is over."))
