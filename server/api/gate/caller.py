"""Who makes a request: a browser by its cookie, a program by its key, or the machine itself."""

from __future__ import annotations

import ipaddress
from collections.abc import Mapping
from http.cookies import CookieError, SimpleCookie

from starlette.requests import HTTPConnection
from starlette.types import Scope

from server.access import Access, Caller, Need
from server.access.rights import NO_RIGHTS
from server.api.gate.origin import LOOPBACK_NAMES, host_name, host_port

COOKIE = "plugpilot"
COOKIE_AGE_S = 400 * 24 * 3600  # browsers keep none for longer
_BEARER = "bearer "
_FORWARDED = ("forwarded", "x-forwarded-for", "x-forwarded-host", "x-real-ip", "via")
MACHINE_RIGHTS = NO_RIGHTS | {Need.STOP}


def caller_of(connection: HTTPConnection) -> Caller:
    """Who makes this request, as the gate found out."""
    caller = connection.state.caller
    assert isinstance(caller, Caller)  # noqa: S101 - the gate sets it
    return caller


def scheme_of(scope: Scope) -> str:
    """The scheme of the page that asks, http or https; WebSockets have none of their own."""
    return "https" if scope["scheme"] in {"https", "wss"} else "http"


def cookie_name(headers: Mapping[str, str], scheme: str) -> str:
    """Name of the session's cookie.

    Browsers give a cookie to all ports of a host, so the port is in the name: two robots on one
    machine do not sign each other out. The prefix __Host- makes a browser insist on https.
    """
    port = host_port(headers.get("host", ""))
    name = COOKIE if port is None else f"{COOKIE}-{port}"
    return f"__Host-{name}" if scheme == "https" else name


def find_caller(scope: Scope, headers: Mapping[str, str], access: Access) -> Caller:
    """Look at key, cookie and address."""
    address = scope["client"][0] if scope.get("client") else ""
    secret = _key_in(headers) or _cookie_in(headers, scheme_of(scope))
    if secret is not None:
        known = access.register.caller(secret, address)
        if known is not None:
            return known
    served_at = scope["server"][0] if scope.get("server") else ""
    if is_machine_itself(headers, address, served_at):
        return Caller("machine", "", "", MACHINE_RIGHTS, address)
    return Caller("unknown", "", "", NO_RIGHTS, address)


def is_machine_itself(headers: Mapping[str, str], address: str, served_at: str) -> bool:
    """Whether somebody at the machine asks: its own screen, its command line.

    What comes from the address that it was sent to has not left the machine, either.

    A proxy on the same machine comes from the same address, but it forwards the name that was
    asked for, or says that it forwards.
    """
    if any(name in headers for name in _FORWARDED):
        return False
    name = host_name(headers.get("host", ""))
    if _is_loopback(address):
        return name in LOOPBACK_NAMES
    return address == served_at == name


def _is_loopback(address: str) -> bool:
    try:
        ip = ipaddress.ip_address(address)
    except ValueError:
        return False
    if isinstance(ip, ipaddress.IPv6Address) and ip.ipv4_mapped is not None:
        return ip.ipv4_mapped.is_loopback
    return ip.is_loopback


def _key_in(headers: Mapping[str, str]) -> str | None:
    value = headers.get("authorization", "")
    return value[len(_BEARER) :].strip() if value.lower().startswith(_BEARER) else None


def _cookie_in(headers: Mapping[str, str], scheme: str) -> str | None:
    try:
        cookies = SimpleCookie(headers.get("cookie", ""))
    except CookieError:
        return None
    morsel = cookies.get(cookie_name(headers, scheme))
    return None if morsel is None else morsel.value
