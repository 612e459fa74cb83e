"""The database: opened, checked, and used from one worker thread.

When it cannot be written any more - the disk is full or write-protected, the file damaged, the
server gone - work goes on in memory, so that the robot can still be unplugged. What was changed
there is done at home as soon as that works again; until then ``problem`` says what is wrong.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from datetime import datetime
from pathlib import Path
from typing import TypeVar

from sqlalchemy import Engine
from sqlalchemy.exc import DBAPIError, SQLAlchemyError
from sqlalchemy.orm import Session

from server.storage.errors import DatabaseBrokenError, LostDatabaseError, StorageError
from server.storage.home import home_of
from server.storage.spare import IS_SPARE, Spare
from server.storage.trouble import from_database

_log = logging.getLogger(__name__)

T = TypeVar("T")

RETRY_S = 5.0
"""How often it is tried to go back home."""


class Database:
    """Runs pieces of work, each in one transaction, off the event loop and in order.

    A transaction that has returned is on disk, unless there is a ``problem``. One whose caller is
    cancelled runs to its end all the same.

    Args:
        folder: The data folder; made if missing. None keeps everything in memory.
        url: Of a PostgreSQL server, in place of an SQLite file in the folder.
        backups_kept: How many daily copies of the SQLite file are kept; 0 makes none.

    Raises:
        StorageError: the folder cannot be made, or a library is missing.
    """

    def __init__(
        self, folder: Path | None, *, url: str | None = None, backups_kept: int = 0
    ) -> None:
        self._home = home_of(folder, url, backups_kept)
        self._spare: Spare | None = None
        self._listeners: list[Callable[[], None]] = []
        self._retrying: asyncio.Task[None] | None = None
        # One worker: SQLite has one writer anyway, and the order of the journal stays the order
        # of the calls.
        self._worker = ThreadPoolExecutor(max_workers=1, thread_name_prefix="database")

    @property
    def problem(self) -> LostDatabaseError | None:
        """Why nothing can be kept for now; None when all is well."""
        return self._spare.trouble if self._spare else None

    def listen(self, listener: Callable[[], None]) -> None:
        """Call ``listener`` whenever ``problem`` has changed."""
        self._listeners.append(listener)

    async def open(self) -> None:
        """Check the database and make what is missing.

        One that has worked before and cannot be used now is no error, but a ``problem``.

        Raises:
            DataFolderError: the folder or file cannot be written.
            DatabaseVersionError: a newer version of PlugPilot made the database.
        """
        await self.in_order(self._open)

    async def run(self, work: Callable[[Session], T]) -> T:
        """Run ``work`` in a transaction and return its result.

        Raises:
            StorageError: the database refused; nothing of the work was kept.
        """
        return await self.in_order(lambda: self._transact(work))

    async def in_order(self, call: Callable[[], T]) -> T:
        """Call something that blocks in the worker, between the transactions."""
        before = self.problem
        try:
            return await asyncio.get_running_loop().run_in_executor(self._worker, call)
        finally:
            if self.problem is not before:
                self._tell()

    async def back_up_if_due(self, now: datetime) -> None:
        """Make today's copy if there is none yet. Transactions go on meanwhile.

        Args:
            now: The date.
        """
        if self.problem is None:
            await asyncio.to_thread(self._home.back_up_if_due, now)

    async def close(self) -> None:
        """Finish what was begun and close the file."""
        if self._retrying is not None:
            self._retrying.cancel()
            await asyncio.wait({self._retrying})
        await self.in_order(self._close)
        self._worker.shutdown(wait=False)

    def _open(self) -> None:
        try:
            self._home.prepare()
        except StorageError as trouble:
            if not (isinstance(trouble, LostDatabaseError) and self._home.worked_before):
                self._home.engine.dispose()
                raise
            self._move_out(trouble)

    def _transact(self, work: Callable[[Session], T]) -> T:
        if self._spare is None:
            try:
                return self._do(self._home.engine, work)
            except LostDatabaseError as trouble:
                self._move_out(trouble)
        assert self._spare is not None  # noqa: S101 - moved out above, or before
        changes = self._spare.changes()
        result = self._do(self._spare.engine, work)
        if self._spare.changes() != changes:
            self._spare.owe(work)
        return result

    def _do(self, engine: Engine, work: Callable[[Session], T]) -> T:
        info = {IS_SPARE: engine is not self._home.engine}
        try:
            with Session(engine, expire_on_commit=False, info=info) as session, session.begin():
                return work(session)
        except DBAPIError as error:
            raise from_database(error, self._home.name) from error
        except SQLAlchemyError as error:
            raise StorageError(f"The database refused: {error}", file=self._home.name) from error

    def _move_out(self, trouble: LostDatabaseError) -> None:
        self._home.engine.dispose()
        self._spare = Spare(self._home, trouble)
        _log.error("nothing can be kept for now: %s %s", trouble.detail, trouble.remedy)

    def _go_home(self) -> None:
        """Do at home what was done in memory, if home can be used again."""
        spare = self._spare
        if spare is None or isinstance(spare.trouble, DatabaseBrokenError):
            return
        try:
            self._home.prepare()
            self._do(self._home.engine, lambda session: [work(session) for work in spare.owed])
        except StorageError as error:
            self._home.engine.dispose()
            if isinstance(error, DatabaseBrokenError):
                spare.trouble = error
            return
        _log.warning("data can be kept again; caught up on %d changes", len(spare.owed))
        self._spare = None
        spare.engine.dispose()

    def _close(self) -> None:
        self._go_home()
        if self._spare is not None and self._spare.owed:
            _log.error("%d changes could not be kept and are lost", len(self._spare.owed))
        self._home.engine.dispose()

    def _tell(self) -> None:
        if self.problem is not None and (self._retrying is None or self._retrying.done()):
            self._retrying = asyncio.create_task(self._retry(), name="database retry")
        for listener in self._listeners:
            listener()

    async def _retry(self) -> None:
        with contextlib.suppress(asyncio.CancelledError):
            while self.problem is not None and not isinstance(self.problem, DatabaseBrokenError):
                await asyncio.sleep(RETRY_S)
                await self.in_order(self._go_home)
