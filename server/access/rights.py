"""Who may do what: the rights, and which of them each role and each scope of a key has."""

from __future__ import annotations

from collections.abc import Mapping
from enum import StrEnum


class Need(StrEnum):
    """What an operation needs.

    - ANYONE: nothing; the caller may be unknown.
    - STOP: to be known at all. From the machine itself nobody needs anything for it.
    - PERSON: to be a paired person; a key does not do.
    - READ: to see state, pictures and recordings.
    - OPERATE: to start and end jobs, to release a stop, to switch the drives.
    - CHARGE_POINT: to steer charging as an energy manager does.
    - SERVICE: to jog, to calibrate, to change vehicles.
    - ADMIN: to decide who may do what.
    """

    ANYONE = "anyone"
    STOP = "stop"
    PERSON = "person"
    READ = "read"
    OPERATE = "operate"
    CHARGE_POINT = "charge-point"
    SERVICE = "service"
    ADMIN = "admin"


class Role(StrEnum):
    """What a person is to the robot."""

    VIEWER = "viewer"
    RESIDENT = "resident"
    TECHNICIAN = "technician"
    OWNER = "owner"


class Scope(StrEnum):
    """What a key is for."""

    READ = "read"
    OPERATE = "operate"
    CHARGE_POINT = "charge-point"
    SERVICE = "service"
    ADMIN = "admin"


Rights = frozenset[Need]

NO_RIGHTS: Rights = frozenset({Need.ANYONE})

_VIEWER = NO_RIGHTS | {Need.STOP, Need.PERSON, Need.READ}
_RESIDENT = _VIEWER | {Need.OPERATE, Need.CHARGE_POINT}
_TECHNICIAN = _RESIDENT | {Need.SERVICE}

ROLE_RIGHTS: Mapping[Role, Rights] = {
    Role.VIEWER: _VIEWER,
    Role.RESIDENT: _RESIDENT,
    Role.TECHNICIAN: _TECHNICIAN,
    Role.OWNER: _TECHNICIAN | {Need.ADMIN},
}

SCOPE_RIGHTS: Mapping[Scope, Rights] = {
    Scope.READ: NO_RIGHTS | {Need.READ},
    Scope.OPERATE: NO_RIGHTS | {Need.STOP, Need.READ, Need.OPERATE},
    Scope.CHARGE_POINT: NO_RIGHTS | {Need.CHARGE_POINT},
    Scope.SERVICE: NO_RIGHTS | {Need.STOP, Need.READ, Need.OPERATE, Need.SERVICE},
    Scope.ADMIN: frozenset(Need) - {Need.PERSON},
}
"""A key that only reads, or only steers charging, does not stop the robot: a leaked one would let
a stranger hold it up. Who operates may stop."""
