"""Everything about access, put together around one database."""

from __future__ import annotations

import asyncio
import importlib
from datetime import timedelta
from typing import TYPE_CHECKING

from server.access.audit import BURST_S, AuditLog
from server.access.limits import PER_S, Attempts
from server.access.pairing import Pairing
from server.access.register import SEEN_EVERY_S, Register
from server.access.store import AccessStore
from server.config.access import AccessSettings
from server.storage.database import Database
from server.timing import Calendar

if TYPE_CHECKING:
    from server.access.passkeys import Passkeys


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
        self._calendar = calendar
        self._database = database
        self._reading: asyncio.Task[None] | None = None
        self._passkeys: Passkeys | None = None
        self.attempts = Attempts(per_s=PER_S * speed)

    async def passkeys(self) -> Passkeys:
        """Passkeys. Their library takes a fifth of a second to load: when it is first needed."""
        if self._passkeys is None:
            module = await asyncio.to_thread(importlib.import_module, "server.access.passkeys")
            made: Passkeys = module.Passkeys(self.register, self.audit, self._calendar.now)
            self._passkeys = self._passkeys or made
        return self._passkeys

    async def start(self) -> None:
        """Read everybody from the database, and again when it comes back from a failure.

        What cannot be read at the start knows nobody.
        """
        await self.register.load()
        self._database.listen(self._database_changed)

    async def close(self) -> None:
        """Write what was not written yet."""
        if self._reading is not None:
            await asyncio.wait({self._reading})
        await self.register.close()
        await self.audit.close()

    def _database_changed(self) -> None:
        if self._database.problem is None:
            self._reading = asyncio.get_running_loop().create_task(
                self.register.load(), name="read who is known"
            )
