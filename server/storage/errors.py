"""Errors of storage.

StorageError
├── DataFolderError       the data folder cannot be used
├── DatabaseBrokenError   the database cannot be read
└── DatabaseVersionError  another version of PlugPilot made the database
"""

from __future__ import annotations

from server.errors import PlugPilotError


class StorageError(PlugPilotError):
    """Something could not be kept."""

    code = "storage"
    title = "PlugPilot cannot save its data"
    status = 503
    remedy = "Check that the disk has free space and is not write-protected."


class DataFolderError(StorageError):
    """The data folder cannot be used."""

    code = "data_folder"
    title = "The data folder cannot be used"
    remedy = "Choose a folder that PlugPilot may write to: --data-dir FOLDER."


class DatabaseBrokenError(StorageError):
    """The database file cannot be read as one."""

    code = "database_broken"
    title = "The database is damaged"
    remedy = "Move the file away and start again, or put a backup in its place."


class DatabaseVersionError(StorageError):
    """The database was made by another version of PlugPilot."""

    code = "database_version"
    title = "The database belongs to another version of PlugPilot"
    remedy = "Use the version that made it, or move the file away and start again."
