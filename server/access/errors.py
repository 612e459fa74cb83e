"""Errors of access.

AccessError
├── NotPairedError       the browser or program is not known
├── ForbiddenError       known, but without the right
├── WrongOriginError     a page from elsewhere made the browser ask
├── UnknownHostError     asked for under a name that is not ours
├── InvitationError      not valid: used, expired, withdrawn or never made
├── TooManyAttemptsError slow down
├── LastOwnerError       nobody could decide anything any more
├── NoSuchEntryError     no such person, device, key, invitation or passkey
└── PasskeyError         the passkey was not accepted
"""

from __future__ import annotations

from server.errors import PlugPilotError


class AccessError(PlugPilotError):
    """Somebody may not do that."""

    code = "access"
    title = "Not allowed"
    status = 403


class NotPairedError(AccessError):
    """The browser or program is not known."""

    code = "not_paired"
    title = "This browser is not paired with the robot"
    status = 401
    remedy = "Open an invitation from the owner of the robot; programs need a key."


class ForbiddenError(AccessError):
    """Known, but without the right."""

    code = "forbidden"
    title = "You may not do that"
    remedy = "Ask the owner of the robot."


class WrongOriginError(AccessError):
    """A page from elsewhere made the browser ask."""

    code = "wrong_origin"
    title = "The request came from another page"
    remedy = "Use the robot's own page."


class UnknownHostError(AccessError):
    """Asked for under a name that is not ours."""

    code = "unknown_host"
    title = "The robot does not answer to this name"
    status = 421
    remedy = "Use the robot's address, or add the name to access.host_names."


class InvitationError(AccessError):
    """Not valid: used, expired, withdrawn or never made. Which of these is not told."""

    code = "invitation"
    title = "This invitation is not valid"
    remedy = "Ask for a new one. On the robot's computer `plugpilot pair` prints one."


class TooManyAttemptsError(AccessError):
    """Too many attempts from one address."""

    code = "too_many_attempts"
    title = "Too many attempts"
    status = 429
    remedy = "Wait a minute, then try again."


class LastOwnerError(AccessError):
    """Without an owner nobody could decide anything any more."""

    code = "last_owner"
    title = "The robot needs an owner"
    status = 409
    remedy = "Make somebody else an owner first."


class NoSuchEntryError(AccessError):
    """There is no such person, device, key, invitation or passkey."""

    code = "no_such_entry"
    title = "There is no such entry"
    status = 404
    remedy = "Load the list again."


class PasskeyError(AccessError):
    """The passkey was not accepted. Why is written into the audit trail only."""

    code = "passkey"
    title = "The passkey was not accepted"
    remedy = "Try again, or ask the owner for an invitation."
