"""What all stations with an HTTP API have in common."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable

from drivers.station.errors import StationUnsupportedError
from drivers.station.web import WebDevice


class WebStation(ABC):
    """A name, and a connection that opens and closes.

    Args:
        web: The device.
    """

    def __init__(self, web: WebDevice) -> None:
        self._web = web

    @property
    def name(self) -> str:
        """Name a person recognises."""
        return self._web.name

    async def open(self) -> None:
        """Connect to the station and look whether it is one.

        After an error it may be used all the same: it works as soon as the station does.

        Raises:
            StationError: it is not there, or something else is.
        """
        self._web.open()
        await self._look()

    async def close(self) -> None:
        """Disconnect; the station goes on by itself. Safe to call twice."""
        await self._web.close()

    async def limit_current(self, current_a: float) -> None:
        """Most cannot; those that can say so in their capabilities.

        Raises:
            StationUnsupportedError: it cannot.
        """
        raise StationUnsupportedError(
            f"{self.name} cannot be limited to {current_a:g} A from here: set it at the station."
        )

    def listen(self, listener: Callable[[], None]) -> None:
        """Most only answer, and so never call ``listener``."""
        del listener

    @abstractmethod
    async def _look(self) -> None:
        """Ask the station once; raises a StationError when it is not what was expected."""
