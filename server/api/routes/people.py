"""Access: who is known, for the owner."""

from __future__ import annotations

import json
from collections.abc import AsyncIterator
from dataclasses import asdict
from datetime import timedelta
from typing import Annotated

from fastapi import APIRouter, Path, Query, Request, Response
from fastapi.responses import StreamingResponse

from server.access import Access
from server.access.audit import AuditEntry
from server.access.model import ApiKey, Person
from server.api.dependencies import ServicesDep
from server.api.gate import caller_of
from server.api.invitation_address import issued
from server.api.pagination import Cursor, Limit, number_in, page_by_id, split_page
from server.api.problems import problem_responses
from server.schema.access import (
    AuditPage,
    AuditRecord,
    DeviceEntry,
    InvitationEntry,
    InvitationList,
    InvitationRequest,
    IssuedInvitation,
    IssuedKey,
    KeyEntry,
    KeyList,
    KeyRequest,
    PersonEntry,
    PersonList,
    PersonSettings,
)

router = APIRouter(prefix="/access", tags=["access"])

EntryId = Annotated[str, Path(max_length=64)]


@router.get(
    "/people",
    operation_id="listPeople",
    summary="List people and their devices",
    responses=problem_responses(400),
)
async def list_people(
    services: ServicesDep, cursor: Cursor = None, limit: Limit = 100
) -> PersonList:
    """Everybody who is paired, with devices; who came first stands first."""
    access = services.access
    page, last = page_by_id(access.register.people.values(), cursor, limit)
    return PersonList(items=[_person(access, person) for person in page], next_cursor=last)


@router.put(
    "/people/{person_id}",
    operation_id="changePerson",
    summary="Change a person",
    responses=problem_responses(404, 409, 422),
)
async def change_person(
    person_id: EntryId, settings: PersonSettings, services: ServicesDep
) -> PersonEntry:
    """Change somebody's name, role, or the end of the rights."""
    person = await services.access.register.change_person(
        person_id, name=settings.name, role=settings.role, ends_at=settings.ends_at
    )
    return _person(services.access, person)


@router.delete(
    "/people/{person_id}",
    status_code=204,
    response_class=Response,
    operation_id="removePerson",
    summary="Forget a person",
    responses=problem_responses(404, 409),
)
async def remove_person(person_id: EntryId, services: ServicesDep) -> None:
    """Forget somebody: all devices are out at once."""
    await services.access.register.remove_person(person_id)


@router.delete(
    "/devices/{device_id}",
    status_code=204,
    response_class=Response,
    operation_id="removeDevice",
    summary="Forget a device",
    responses=problem_responses(404),
)
async def remove_device(device_id: EntryId, services: ServicesDep) -> None:
    """Forget one device: it is out at once."""
    await services.access.register.remove_device(device_id)


@router.get(
    "/invitations",
    operation_id="listInvitations",
    summary="List open invitations",
    responses=problem_responses(400),
)
async def list_invitations(
    services: ServicesDep, cursor: Cursor = None, limit: Limit = 100
) -> InvitationList:
    """Invitations that can still be used, oldest first."""
    invitations = await services.access.pairing.open_invitations()
    page, last = page_by_id(invitations, cursor, limit)
    return InvitationList(
        items=[
            InvitationEntry(
                id=each.id,
                name=each.name,
                role=each.role,
                created_by=each.created_by,
                created_at=each.created_at,
                expires_at=each.expires_at,
                ends_at=each.ends_at,
            )
            for each in page
        ],
        next_cursor=last,
    )


@router.post(
    "/invitations",
    status_code=201,
    operation_id="createInvitation",
    summary="Invite somebody",
    responses=problem_responses(422),
)
async def create_invitation(
    wanted: InvitationRequest, request: Request, services: ServicesDep
) -> IssuedInvitation:
    """Invite somebody. The address is shown once and can be used once."""
    caller = caller_of(request)
    invitation, secret = await services.access.pairing.invite(
        name=wanted.name,
        role=wanted.role,
        created_by=caller.label,
        address=caller.address,
        valid=timedelta(minutes=wanted.valid_minutes),
        ends_at=wanted.ends_at,
    )
    return issued(request, services.settings.server, secret, invitation.expires_at)


@router.delete(
    "/invitations/{invitation_id}",
    status_code=204,
    response_class=Response,
    operation_id="withdrawInvitation",
    summary="Withdraw an invitation",
    responses=problem_responses(404),
)
async def withdraw_invitation(
    invitation_id: EntryId, request: Request, services: ServicesDep
) -> None:
    """Make an invitation void."""
    caller = caller_of(request)
    await services.access.pairing.withdraw(invitation_id, by=caller.label, address=caller.address)


@router.get("/keys", operation_id="listKeys", summary="List keys", responses=problem_responses(400))
async def list_keys(services: ServicesDep, cursor: Cursor = None, limit: Limit = 100) -> KeyList:
    """All keys, oldest first."""
    page, last = page_by_id(services.access.register.keys.values(), cursor, limit)
    return KeyList(items=[KeyEntry(**_key(key)) for key in page], next_cursor=last)


@router.post(
    "/keys",
    status_code=201,
    operation_id="createKey",
    summary="Make a key",
    responses=problem_responses(422),
)
async def create_key(wanted: KeyRequest, request: Request, services: ServicesDep) -> IssuedKey:
    """Make a key for a program. It is shown once."""
    key, secret = await services.access.register.add_key(
        wanted.name, tuple(dict.fromkeys(wanted.scopes)), caller_of(request).label
    )
    return IssuedKey(**_key(key), key=secret)


@router.delete(
    "/keys/{key_id}",
    status_code=204,
    response_class=Response,
    operation_id="revokeKey",
    summary="Revoke a key",
    responses=problem_responses(404),
)
async def revoke_key(key_id: EntryId, services: ServicesDep) -> None:
    """Revoke a key: it is out at once."""
    await services.access.register.revoke_key(key_id)


@router.get(
    "/audit",
    operation_id="listAudit",
    summary="List the audit trail",
    responses=problem_responses(400, 422),
)
async def list_audit(
    services: ServicesDep,
    cursor: Cursor = None,
    limit: Limit = 50,
    security: Annotated[bool, Query(description="Only what concerns access")] = False,
) -> AuditPage:
    """Who did what, from where; newest first."""
    entries = await services.access.audit.page(
        before=number_in(cursor), limit=limit + 1, security=security
    )
    page, last = split_page(entries, limit)
    return AuditPage(
        items=[AuditRecord(**asdict(entry)) for entry in page],
        next_cursor=str(last.sequence) if last else None,
    )


_LINES = "application/x-ndjson"


@router.get(
    "/audit/export",
    operation_id="exportAudit",
    summary="Export the audit trail",
    response_class=StreamingResponse,
    responses={
        200: {
            "content": {_LINES: {"schema": {"type": "string"}}},
            "description": "One JSON object a line",
        }
    },
)
async def export_audit(services: ServicesDep) -> StreamingResponse:
    """The whole audit trail, oldest entry first. `plugpilot audit --check` verifies its chain."""
    return StreamingResponse(
        _lines(services.access.audit.everything()),
        media_type=_LINES,
        headers={"Content-Disposition": 'attachment; filename="plugpilot-audit.jsonl"'},
    )


async def _lines(entries: AsyncIterator[AuditEntry]) -> AsyncIterator[bytes]:
    async for entry in entries:
        yield json.dumps(entry.as_json(), separators=(",", ":")).encode() + b"\n"


def _person(access: Access, person: Person) -> PersonEntry:
    register = access.register
    devices = [d for d in register.devices.values() if d.person_id == person.id]
    return PersonEntry(
        id=person.id,
        name=person.name,
        role=person.role,
        ends_at=person.ends_at,
        created_at=person.created_at,
        devices=[
            DeviceEntry(
                id=device.id,
                name=device.name,
                created_at=device.created_at,
                last_used_at=device.last_used_at,
                last_from=device.last_from,
            )
            for device in sorted(devices, key=lambda d: d.last_used_at, reverse=True)
        ],
        passkeys=sum(p.person_id == person.id for p in register.passkeys.values()),
    )


def _key(key: ApiKey) -> dict[str, object]:
    return {
        "id": key.id,
        "name": key.name,
        "hint": key.hint,
        "scopes": list(key.scopes),
        "created_by": key.created_by,
        "created_at": key.created_at,
        "last_used_at": key.last_used_at,
        "last_from": key.last_from,
    }
