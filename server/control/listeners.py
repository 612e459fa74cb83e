"""Whoever wants to know that something has changed."""

from __future__ import annotations

import logging
from collections.abc import Callable

_log = logging.getLogger(__name__)


class Listeners:
    """Called one after the other; one that fails stops neither the others nor the robot."""

    def __init__(self) -> None:
        self._listeners: list[Callable[[], None]] = []

    def add(self, listener: Callable[[], None]) -> None:
        """Call ``listener`` after every change from now on."""
        self._listeners.append(listener)

    def tell(self) -> None:
        """Something has changed."""
        for listener in self._listeners:
            try:
                listener()
            except Exception:  # noqa: BLE001 - it is logged; who looks on must not stop who moves
                _log.exception("a listener failed")
