"""Take the power from the plug, in the order that keeps it off.

A stopped station starts again by itself as soon as an energy manager wants it. So the manager goes
off first, with its mode remembered, then a hold at the station outranks everybody else (both are
``hold``), and only then the station itself is told to stop.
"""

from __future__ import annotations

from drivers.station import StationDriver, StationError
from server.control.errors import StationUnsafeError


async def forbid_power(station: StationDriver) -> None:
    """Manager off, hold, stop: as much of it as the station can do.

    Raises:
        StationUnsafeError: the station does not answer, or does not obey.
    """
    try:
        if station.capabilities.holds:
            await station.hold()
        if station.capabilities.switches:
            await station.stop()
    except StationError as error:
        raise StationUnsafeError(str(error)) from error


async def unlock(station: StationDriver) -> None:
    """Open the connector lock where the station can.

    Raises:
        StationUnsafeError: it cannot be opened.
    """
    if station.capabilities.unlocks:
        try:
            await station.unlock()
        except StationError as error:
            raise StationUnsafeError(str(error)) from error


async def end_hold(station: StationDriver) -> None:
    """Give the station back to whoever controls it otherwise, and a manager its mode.

    Raises:
        StationUnsafeError: the station does not answer.
    """
    if station.capabilities.holds:
        try:
            await station.release()
        except StationError as error:
            raise StationUnsafeError(
                f"The hold on the station could not be released: {error}"
            ) from error
