"""Everything about access, put together around one database."""

from __future__ import annotations

from datetime import timedelta

from server.access.audit import BURST_S, AuditLog
from server.access.limits import PER_S, Attempts
from server.access.pairing import Pairing
from server.access.passkeys import Passkeys
from server.access.register import SEEN_EVERY_S, Register
from server.access.store import AccessStore
from server.config.access import AccessSettings
from server.storage.database import Database
from server.timing import Calendar


class Access:
    """Who may do what.

    Args:
        database: Open.
        calendar: Dates.
        settings: Section `access` of the configuration.
        speed: Seconds of the event loop per second of the wall clock.

    Attributes:
        settings: Section `access` of the configuration.
        register: Everybody who is known.
        pairing: Invitations.
        passkeys: Passkeys.
        audit: The audit trail.
        attempts: How often an address may still try to get in.
    """

    def __init__(
        self, database: Database, calendar: Calendar, settings: AccessSettings, speed: float = 1.0
    ) -> None:
        store, now = AccessStore(database), calendar.now
        self.settings = settings
        self.audit = AuditLog(database, now, BURST_S * speed)
        self.register = Register(
            store, now, timedelta(days=settings.unused_device_days), SEEN_EVERY_S * speed
        )
        self.pairing = Pairing(store, self.register, self.audit, now)
        self.passkeys = Passkeys(self.register, self.audit, now)
        self.attempts = Attempts(per_s=PER_S * speed)

    async def start(self) -> None:
        """Read everybody from the database."""
        await self.register.load()

    async def close(self) -> None:
        """Write what was not written yet."""
        await self.register.close()
        await self.audit.close()
