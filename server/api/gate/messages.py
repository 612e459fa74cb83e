"""Messages on the WebSocket: what each needs, and what the audit trail hears of it."""

from __future__ import annotations

from server.access import MESSAGES, Access, Caller
from server.access.audit import OPERATION
from server.access.errors import ForbiddenError

QUIET = frozenset({"resync", "jog_end"})
"""Messages that do nothing a trail need know of."""


def admit_message(access: Access, caller: Caller, kind: str) -> None:
    """Let a message pass.

    Args:
        access: Who may do what.
        caller: Who opened the connection. Rights that have ended since do not count.
        kind: Type of the message.

    Raises:
        ForbiddenError: the caller has no right to it, or the message is in no table.
    """
    operation = f"message {kind}"
    need = MESSAGES.get(kind)
    if need is None or need not in access.register.rights_now(caller):
        access.audit.record_burst(
            "refused",
            actor=caller.label,
            address=caller.address,
            operation=operation,
            code=ForbiddenError.code,
        )
        raise ForbiddenError(f"You may not send {kind!r} messages.")
    if kind not in QUIET:
        access.audit.record_burst(
            OPERATION, actor=caller.label, address=caller.address, operation=operation
        )
