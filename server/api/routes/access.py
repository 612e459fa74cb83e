"""Access: getting in, and getting out."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Header, Path, Request, Response

from server.access import Caller, Need
from server.access.errors import ForbiddenError
from server.access.model import Origin, Passkey, Person
from server.access.pairing import VALID
from server.api.dependencies import ServicesDep
from server.api.gate import caller_of
from server.api.gate.caller import COOKIE_AGE_S, cookie_name, scheme_of
from server.api.gate.origin import LOOPBACK_NAMES, host_name, is_address
from server.api.invitation_address import issued
from server.api.pagination import Cursor, Limit, page_by_id
from server.api.problems import problem_responses
from server.schema.access import (
    AccessSession,
    IssuedInvitation,
    PairingRequest,
    PasskeyAnswer,
    PasskeyEntry,
    PasskeyList,
    PasskeyOptions,
    PersonSummary,
)
from server.services import Services

router = APIRouter(prefix="/access", tags=["access"])

EntryId = Annotated[str, Path(max_length=64)]
UserAgent = Annotated[str, Header(include_in_schema=False)]


@router.get("/session", operation_id="getSession", summary="Read what this browser is")
async def get_session(request: Request, response: Response, services: ServicesDep) -> AccessSession:
    """What this browser or program is to the robot; anybody may ask about himself."""
    caller = caller_of(request)
    name = cookie_name(request.headers, scheme_of(request.scope))
    if caller.kind == "person" and name in request.cookies:
        # Browsers forget a cookie at its age: with every opening of the page it is young again.
        _give_cookie(request, response, request.cookies[name])
    return _session(request, services, caller)


@router.post(
    "/pairing",
    operation_id="pairDevice",
    summary="Pair this browser",
    responses=problem_responses(403, 422, 429),
)
async def pair(
    wanted: PairingRequest,
    request: Request,
    response: Response,
    services: ServicesDep,
    user_agent: UserAgent = "",
) -> AccessSession:
    """Use an invitation: this browser becomes a device of the person who is invited.

    What it was before, it is no longer.
    """
    before = caller_of(request)
    _, _, cookie = await services.access.pairing.pair(wanted.secret, user_agent, before.address)
    return await _welcome(request, response, services, cookie, before)


@router.delete(
    "/session",
    status_code=204,
    response_class=Response,
    operation_id="endSession",
    summary="Sign out",
)
async def end_session(request: Request, response: Response, services: ServicesDep) -> None:
    """Sign this browser out."""
    caller = caller_of(request)
    await services.access.register.remove_device(caller.id)
    name = cookie_name(request.headers, scheme_of(request.scope))
    response.delete_cookie(
        name, secure=_is_secure(request), httponly=True, samesite="strict", path="/"
    )


@router.post(
    "/devices/invitation",
    status_code=201,
    operation_id="inviteOwnDevice",
    summary="Invite another device of oneself",
)
async def invite_own_device(request: Request, services: ServicesDep) -> IssuedInvitation:
    """An invitation for another device of oneself."""
    caller, person = caller_of(request), _person(request)
    invitation, secret = await services.access.pairing.invite(
        name=person.name,
        role=person.role,
        created_by=caller.label,
        address=caller.address,
        person_id=person.id,
    )
    return issued(request, services.settings.server, secret, invitation.expires_at)


@router.post(
    "/owner-invitation",
    status_code=201,
    operation_id="showOwnerInvitation",
    summary="Invite the first owner",
    responses=problem_responses(403),
)
async def show_owner_invitation(request: Request, services: ServicesDep) -> IssuedInvitation:
    """The invitation of the first owner, for the robot's own screen only."""
    caller = caller_of(request)
    if not _is_own_screen(services, caller):
        raise ForbiddenError("Only the robot's own screen may, and only before it has an owner.")
    secret = await services.access.pairing.invite_owner(address=caller.address, valid=VALID)
    return issued(request, services.settings.server, secret, services.calendar.now() + VALID)


@router.get(
    "/passkeys",
    operation_id="listOwnPasskeys",
    summary="List one's own passkeys",
    responses=problem_responses(400),
)
async def list_passkeys(
    request: Request, services: ServicesDep, cursor: Cursor = None, limit: Limit = 100
) -> PasskeyList:
    """One's own passkeys, oldest first."""
    person = _person(request)
    own = [p for p in services.access.register.passkeys.values() if p.person_id == person.id]
    page, last = page_by_id(own, cursor, limit)
    return PasskeyList(items=[_entry(p) for p in page], next_cursor=last)


@router.post(
    "/passkeys/options",
    operation_id="beginPasskey",
    summary="Begin to make a passkey",
    responses=problem_responses(403),
)
async def begin_passkey(request: Request, services: ServicesDep) -> PasskeyOptions:
    """Options for making a passkey."""
    passkeys = await services.access.passkeys()
    return PasskeyOptions(options=passkeys.begin(_person(request), _origin(request)))


@router.post(
    "/passkeys",
    status_code=201,
    operation_id="addPasskey",
    summary="Keep a new passkey",
    responses=problem_responses(403, 422),
)
async def add_passkey(
    answer: PasskeyAnswer, request: Request, services: ServicesDep, user_agent: UserAgent = ""
) -> PasskeyEntry:
    """Keep a passkey that the browser made."""
    passkeys = await services.access.passkeys()
    passkey = await passkeys.add(
        _person(request),
        answer.credential,
        _origin(request),
        user_agent,
        caller_of(request).address,
    )
    return _entry(passkey)


@router.delete(
    "/passkeys/{passkey_id}",
    status_code=204,
    response_class=Response,
    operation_id="removePasskey",
    summary="Forget a passkey",
    responses=problem_responses(404),
)
async def remove_passkey(passkey_id: EntryId, request: Request, services: ServicesDep) -> None:
    """Forget one of one's own passkeys."""
    address = caller_of(request).address
    passkeys = await services.access.passkeys()
    await passkeys.remove(_person(request), passkey_id, address)


@router.post(
    "/login/options",
    operation_id="beginLogin",
    summary="Begin to show a passkey",
    responses=problem_responses(403, 429),
)
async def begin_login(request: Request, services: ServicesDep) -> PasskeyOptions:
    """Options for showing a passkey."""
    passkeys = await services.access.passkeys()
    return PasskeyOptions(options=passkeys.begin_login(_origin(request)))


@router.post(
    "/login",
    operation_id="logIn",
    summary="Log in with a passkey",
    responses=problem_responses(403, 422, 429),
)
async def log_in(
    answer: PasskeyAnswer,
    request: Request,
    response: Response,
    services: ServicesDep,
    user_agent: UserAgent = "",
) -> AccessSession:
    """Show a passkey: this browser becomes a device of its person."""
    before = caller_of(request)
    passkeys = await services.access.passkeys()
    _, _, cookie = await passkeys.log_in(
        answer.credential, _origin(request), user_agent, before.address
    )
    return await _welcome(request, response, services, cookie, before)


async def _welcome(
    request: Request, response: Response, services: Services, cookie: str, before: Caller
) -> AccessSession:
    register = services.access.register
    if before.kind == "person" and before.id in register.devices:
        await register.remove_device(before.id)
    _give_cookie(request, response, cookie)
    caller = register.caller(cookie, before.address)
    return _session(request, services, caller or before)


def _session(request: Request, services: Services, caller: Caller) -> AccessSession:
    person = caller.person
    summary = None
    if person is not None:
        summary = PersonSummary(
            id=person.id, name=person.name, role=person.role, ends_at=person.ends_at
        )
    known = caller.kind in {"person", "key"} and caller.may(Need.STOP)
    return AccessSession(
        paired=known,
        person=summary,
        device_id=caller.id if person is not None else None,
        rights=sorted(caller.rights),
        passkeys=_takes_passkeys(request),
        screen=_is_own_screen(services, caller),
    )


def _is_own_screen(services: Services, caller: Caller) -> bool:
    access = services.access
    if services.database.problem is not None:
        return False  # there may be an owner whom nobody can read
    return access.settings.screen and caller.kind == "machine" and not access.register.has_owner


def _give_cookie(request: Request, response: Response, value: str) -> None:
    response.set_cookie(
        cookie_name(request.headers, scheme_of(request.scope)),
        value,
        max_age=COOKIE_AGE_S,
        secure=_is_secure(request),
        httponly=True,
        samesite="strict",
        path="/",
    )


def _is_secure(request: Request) -> bool:
    return scheme_of(request.scope) == "https"


def _person(request: Request) -> Person:
    person = caller_of(request).person
    if person is None:
        raise ForbiddenError("Only a person can do that.")
    return person


def _origin(request: Request) -> Origin:
    """Where the page is. The gate has made sure that it is a page of this server."""
    host = request.headers.get("host", "")
    if not _takes_passkeys(request):
        raise ForbiddenError(f"Passkeys do not work under {host}.")
    url = request.headers.get("origin") or f"{scheme_of(request.scope)}://{host}"
    return Origin(url, host_name(host) or "")


def _takes_passkeys(request: Request) -> bool:
    """They need a secure origin, and a name: an address does not do."""
    name = host_name(request.headers.get("host", "")) or ""
    by_https = _is_secure(request) or request.headers.get("origin", "").startswith("https:")
    return not is_address(name) and (by_https or name in LOOPBACK_NAMES)


def _entry(passkey: Passkey) -> PasskeyEntry:
    return PasskeyEntry(
        id=passkey.id,
        name=passkey.name,
        created_at=passkey.created_at,
        last_used_at=passkey.last_used_at,
    )
