"""For whoever holds the machine in hand: works on the data folder, whether the server runs or not.

Access to the folder is access to everything anyway, so no other proof is asked for.
"""

from __future__ import annotations

import contextlib
from collections.abc import AsyncIterator
from datetime import timedelta
from pathlib import Path

from server.access.access import Access
from server.access.pairing import VALID
from server.config.access import AccessSettings
from server.storage.database import Database
from server.timing import Calendar


@contextlib.asynccontextmanager
async def opened(folder: Path, settings: AccessSettings) -> AsyncIterator[Access]:
    """Everything about access in a data folder.

    Raises:
        StorageError: the folder or its database cannot be used.
    """
    database = Database(folder)
    await database.open()
    access = Access(database, Calendar(), settings)
    try:
        await access.start()
        yield access
        await access.close()
    finally:
        await database.close()


async def invite_owner(folder: Path, settings: AccessSettings, valid: timedelta = VALID) -> str:
    """The secret of an invitation that makes a browser an owner's.

    Raises:
        StorageError: the folder or its database cannot be used.
    """
    async with opened(folder, settings) as access:
        return await access.pairing.invite_owner(address="", valid=valid)
