"""Errors of storage.

StorageError
├── DataFolderError           the data folder cannot be used
├── FolderInUseError          another PlugPilot uses the data folder
├── DatabaseVersionError      another version of PlugPilot made the database
├── MissingDriverError        a library for this kind of database is not installed
├── LostDatabaseError         for now nothing can be kept
│   ├── DatabaseBrokenError       the database cannot be read
│   ├── DiskFullError             the disk has no room
│   ├── ReadOnlyError             the disk is write-protected
│   ├── DatabaseBusyError         another program holds the database
│   ├── DiskError                 the disk fails
│   └── DatabaseUnreachableError  the database server does not answer
└── BackupError               a backup cannot be made or used
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


class FolderInUseError(StorageError):
    """Another PlugPilot uses the data folder."""

    code = "data_folder_in_use"
    title = "Another PlugPilot uses the data folder"
    remedy = "Stop the other one first, or choose another folder: --data-dir FOLDER."


class DatabaseVersionError(StorageError):
    """The database was made by another version of PlugPilot."""

    code = "database_version"
    title = "The database belongs to another version of PlugPilot"
    remedy = "Use the version that made it, or move the file away and start again."


class MissingDriverError(StorageError):
    """A library for this kind of database is not installed."""

    code = "database_driver"
    title = "A library for this database is missing"
    remedy = "Install it: pip install 'plugpilot[postgres]'."


class LostDatabaseError(StorageError):
    """For now nothing can be kept. The robot can be stopped and unplugged all the same."""


class DatabaseBrokenError(LostDatabaseError):
    """The database file cannot be read as one."""

    code = "database_broken"
    title = "The database is damaged"
    remedy = (
        "Stop PlugPilot, then put a backup in its place: plugpilot restore FILE. Without a backup "
        "begin anew: plugpilot database new. Either keeps the damaged file under another name."
    )


class DiskFullError(LostDatabaseError):
    """The disk has no room."""

    code = "disk_full"
    title = "The disk is full"
    remedy = "Make room on the disk; PlugPilot then goes on by itself."


class ReadOnlyError(LostDatabaseError):
    """The disk is write-protected."""

    code = "disk_read_only"
    title = "The disk is write-protected"
    remedy = "Make the data folder writable. A memory card that protects itself is worn out."


class DatabaseBusyError(LostDatabaseError):
    """Another program holds the database."""

    code = "database_busy"
    title = "Another program holds the database"
    remedy = "End the program that has the database open; PlugPilot then goes on by itself."


class DiskError(LostDatabaseError):
    """The disk fails."""

    code = "disk_error"
    title = "The disk fails"
    remedy = "Check the disk and its cable. Make a backup while it can still be read."


class DatabaseUnreachableError(LostDatabaseError):
    """The database server does not answer."""

    code = "database_unreachable"
    title = "The database server does not answer"
    remedy = "Check storage.url and that the server runs; PlugPilot then goes on by itself."


class BackupError(StorageError):
    """A backup cannot be made or used."""

    code = "backup"
    title = "The backup cannot be made or used"
    status = 409
    remedy = "Choose another file."
