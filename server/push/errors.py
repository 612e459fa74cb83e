"""Errors of notifications.

PushError
└── PushRefusedError   the subscription of a browser cannot be used
"""

from __future__ import annotations

from server.errors import PlugPilotError


class PushError(PlugPilotError):
    """Notifications do not work."""

    code = "push"
    title = "Notifications do not work"
    status = 409
    remedy = "Look at the page instead."


class PushRefusedError(PushError):
    """The subscription of a browser cannot be used."""

    code = "push_refused"
    title = "This browser cannot be notified"
    status = 422
    remedy = "Use another browser, or look at the page instead."
