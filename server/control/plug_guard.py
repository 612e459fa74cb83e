"""Where the plug is, and what that forbids.

The state is written down before the motion that changes it begins, so that after a power cut it
is never more optimistic than the truth.
"""

from __future__ import annotations

import asyncio
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

from server.control.errors import LateralMotionForbiddenError
from server.control.finishing import finish
from server.control.model import PlugState
from twin.joints import JointPosition

LATERAL_TOLERANCE_MM = 0.05
"""Motion of rho1 and rho2 that counts as none: below what the belts transmit. It is counted from
where the plug was held first, so that many small motions do not add up."""

HELD = {PlugState.INSERTED, PlugState.UNKNOWN}
"""The plug is, or may be, in a socket."""


@dataclass(frozen=True, slots=True)
class Corridor:
    """The straight way into the socket: rho1 and rho2 fixed, rho3 along the insertion axis [mm].

    Attributes:
        rho1_mm: Left actuator on the way in.
        rho2_mm: Right actuator on the way in.
        clear_rho3_mm: At or below it the plug is clear of the socket.
        face_rho3_mm: The tip is level with the socket's face.
        depth_rho3_mm: The furthest the plug may go.
    """

    rho1_mm: float
    rho2_mm: float
    clear_rho3_mm: float
    face_rho3_mm: float
    depth_rho3_mm: float

    def holds(self, joints: JointPosition, tolerance_mm: float) -> bool:
        """Whether the joints stand in the corridor, within ``tolerance_mm`` across it."""
        return (
            abs(joints.rho1_mm - self.rho1_mm) <= tolerance_mm
            and abs(joints.rho2_mm - self.rho2_mm) <= tolerance_mm
            and joints.rho3_mm <= self.depth_rho3_mm + tolerance_mm
        )


@dataclass(frozen=True, slots=True)
class PlugRecord:
    """What is written down about the plug."""

    state: PlugState
    corridor: Corridor | None


class PlugStore(Protocol):
    """Keeps the plug record through power cuts."""

    async def load(self) -> PlugRecord | None:
        """The last record, or None on a new installation."""
        ...

    async def save(self, record: PlugRecord) -> None:
        """Write the record down; returns when it is safe on disk."""
        ...


class PlugGuard:
    """Tracks the plug and refuses motion that could break it, the socket or the car."""

    def __init__(self, store: PlugStore, changed: Callable[[], None]) -> None:
        self._store = store
        self._changed = changed
        self._record = PlugRecord(PlugState.UNKNOWN, None)
        self._on_disk: PlugRecord | None = None
        self._writing = asyncio.Lock()
        self._may_enter = False
        self._held_at: JointPosition | None = None

    @property
    def state(self) -> PlugState:
        """Where the plug is."""
        return self._record.state

    @property
    def corridor(self) -> Corridor | None:
        """The way out while the plug is in a socket whose place is known."""
        return self._record.corridor

    async def recover(self) -> None:
        """Take up the last record. A new installation has never plugged anything in."""
        self._on_disk = await self._store.load()
        self._take_over(self._on_disk or PlugRecord(PlugState.FREE, None))

    async def doubt(self) -> None:
        """The evidence contradicts the record: only a person or a withdrawal can settle it."""
        await self._write(PlugRecord(PlugState.UNKNOWN, None))

    async def about_to_enter(self, corridor: Corridor) -> None:
        """The next motion, and only that one, may bring the plug into the socket."""
        await self._write(PlugRecord(PlugState.INSERTED, corridor))
        self._may_enter = True

    def motion_ended(self) -> None:
        """If it was the motion into the socket: from now on only withdrawal is allowed."""
        if self._may_enter:
            self._may_enter = False
            if self._held_at is not None:
                # As deep as the next motion finds it.
                self._held_at = self._held_at._replace(rho3_mm=math.inf)

    async def is_free(self) -> None:
        """The plug is clear of every socket: measured, or confirmed by a person."""
        await self._write(PlugRecord(PlugState.FREE, None))

    async def is_parked(self) -> None:
        """The robot stands in its parking place."""
        await self._write(PlugRecord(PlugState.PARKED, None))

    async def about_to_leave_park(self) -> None:
        """The next motion leaves the parking place."""
        if self.state is PlugState.PARKED:
            await self.is_free()

    def check(self, start: JointPosition, waypoints: list[JointPosition]) -> None:
        """Refuse a motion that the plug's state forbids.

        Args:
            start: Where the joints stand.
            waypoints: The joints along the motion, its end included.

        Raises:
            LateralMotionForbiddenError: with the reason.
        """
        if self.state not in HELD:
            return
        held_at = self._hold(start)
        where = "in the socket" if self.state is PlugState.INSERTED else "at an unknown place"
        lateral_mm = max(
            max(abs(q.rho1_mm - held_at.rho1_mm), abs(q.rho2_mm - held_at.rho2_mm))
            for q in waypoints
        )
        if not lateral_mm <= LATERAL_TOLERANCE_MM:
            raise LateralMotionForbiddenError(
                f"The plug is {where}, and this motion goes {lateral_mm:.1f} mm sideways.",
                plug=self.state.value,
                lateral_mm=lateral_mm,
            )
        allowed_mm = held_at.rho3_mm
        if self._may_enter and self.corridor is not None:
            allowed_mm = max(allowed_mm, self.corridor.depth_rho3_mm)
        excess_mm = max(q.rho3_mm for q in waypoints) - allowed_mm
        if not excess_mm <= LATERAL_TOLERANCE_MM:
            raise LateralMotionForbiddenError(
                f"The plug is {where}, and this motion pushes it {excess_mm:.1f} mm further in "
                "than allowed.",
                plug=self.state.value,
                excess_mm=excess_mm,
            )

    def _hold(self, start: JointPosition) -> JointPosition:
        """Where the plug is held: across the axis as at first, along it as far out as it was."""
        if self._held_at is None:
            self._held_at = start
        elif start.rho3_mm < self._held_at.rho3_mm:
            self._held_at = self._held_at._replace(rho3_mm=start.rho3_mm)
        return self._held_at

    async def _write(self, record: PlugRecord) -> None:
        # To the end even when the caller is cancelled: memory and disk must not part.
        await finish(self._save(record))

    async def _save(self, record: PlugRecord) -> None:
        async with self._writing:
            if record.state in HELD:
                self._take_over(record)  # what forbids counts at once, what allows when on disk
            if record != self._on_disk:
                self._on_disk = None  # until the store has confirmed it
                await self._store.save(record)
                self._on_disk = record
            self._take_over(record)

    def _take_over(self, record: PlugRecord) -> None:
        if record != self._record:
            if not {record.state, self._record.state} <= HELD:
                self._held_at = None
            self._record = record
            self._may_enter = False
            self._changed()
