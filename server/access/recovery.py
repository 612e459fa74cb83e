"""For whoever holds the machine in hand: works on the database, whether the server runs or not.

Access to the database is access to everything anyway, so no other proof is asked for.
"""

from __future__ import annotations

import contextlib
from collections.abc import AsyncIterator
from datetime import timedelta

from server.access.access import Access
from server.access.pairing import VALID
from server.config.access import AccessSettings
from server.config.storage import StorageSettings
from server.storage.database import Database
from server.timing import Calendar


@contextlib.asynccontextmanager
async def opened(storage: StorageSettings, settings: AccessSettings) -> AsyncIterator[Access]:
    """Everything about access in an installation.

    Raises:
        StorageError: its folder or database cannot be used.
    """
    url = storage.url.get_secret_value() if storage.url else None
    database = Database(storage.data_dir, url=url)
    await database.open()
    access = Access(database, Calendar(), settings)
    try:
        if database.problem is not None:  # what was changed now would be lost with this process
            raise database.problem
        await access.start()
        yield access
        await access.close()
    finally:
        await database.close()


async def invite_owner(
    storage: StorageSettings, settings: AccessSettings, valid: timedelta = VALID
) -> str:
    """The secret of an invitation that makes a browser an owner's.

    Raises:
        StorageError: the installation's folder or database cannot be used.
    """
    async with opened(storage, settings) as access:
        return await access.pairing.invite_owner(address="", valid=valid)
