"""The control lease: one holder at a time, with a visible name."""

from __future__ import annotations

from server.control.errors import ControlBusyError, ControlLostError
from server.control.model import Holder, HolderKind
from server.timing import Calendar


class Lease:
    """Proof of control until it is given back."""

    def __init__(self, holder: Holder) -> None:
        self.holder = holder
        self.ended = False

    def require(self) -> None:
        """Make sure that control is still held.

        Raises:
            ControlLostError: it is not.
        """
        if self.ended:
            raise ControlLostError(f"{self.holder.name} no longer has control of the robot.")


class LeaseDesk:
    """Hands out the one lease."""

    def __init__(self, calendar: Calendar) -> None:
        self._calendar = calendar
        self._current: Lease | None = None

    @property
    def holder(self) -> Holder | None:
        """Who has control, or None."""
        return self._current.holder if self._current else None

    def acquire(self, kind: HolderKind, name: str) -> Lease:
        """Give control to ``name``.

        Raises:
            ControlBusyError: somebody has it already.
        """
        if self._current is not None:
            holder = self._current.holder
            raise ControlBusyError(
                f"{holder.name} has had control since {holder.since:%H:%M:%S} UTC.",
                holder=holder.name,
                holder_kind=holder.kind,
            )
        self._current = Lease(Holder(kind=kind, name=name, since=self._calendar.now()))
        return self._current

    def give_back(self, lease: Lease) -> None:
        """End a lease; harmless when it has ended already."""
        lease.ended = True
        if self._current is lease:
            self._current = None
