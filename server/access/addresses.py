"""Under which address other devices reach this machine."""

from __future__ import annotations

import ipaddress
import socket

from server.access.pairing import FRAGMENT

_ELSEWHERE = ("192.0.2.1", 9)  # reserved for documentation; nothing is sent there
ANY = frozenset({"0.0.0.0", "::"})  # noqa: S104 - looked for, not listened on


def is_loopback(host: str) -> bool:
    """Whether only this machine itself can use the address."""
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False


def network_address() -> str | None:
    """This machine's address in its network; None without one."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect(_ELSEWHERE)
        except OSError:
            return None
        return str(probe.getsockname()[0])


def reachable_host(listens_on: str) -> str:
    """A host for the address of a page, such that others reach it if that is possible at all.

    Args:
        listens_on: What the server listens on, such as 127.0.0.1 or 0.0.0.0.
    """
    host = listens_on
    if host in ANY:
        host = network_address() or "127.0.0.1"
    return f"[{host}]" if ":" in host else host


def pairing_address(page: str, secret: str) -> str:
    """The one-time address of an invitation.

    Args:
        page: Where the page is, such as http://192.168.1.20:8000.
        secret: Of the invitation.
    """
    return f"{page}/{FRAGMENT}{secret}"
