"""Where a webhook may go: nobody should be able to make PlugPilot knock at doors inside."""

from __future__ import annotations

import asyncio
import ipaddress
import socket
from collections.abc import Awaitable, Callable, Sequence
from dataclasses import dataclass
from ipaddress import IPv4Address, IPv4Network, IPv6Address, IPv6Network
from urllib.parse import urlsplit

IpAddress = IPv4Address | IPv6Address
IpNetwork = IPv4Network | IPv6Network
Resolve = Callable[[str, int], Awaitable[Sequence[IpAddress]]]

NAT64 = IPv6Network("64:ff9b::/96")


class TargetRefusedError(Exception):
    """This target may not be reached; the message says why and what to do."""


class TargetUnknownError(Exception):
    """The name of the target leads nowhere at the moment."""


@dataclass(frozen=True, slots=True)
class Target:
    """A URL with the one address that was checked for it.

    Attributes:
        url: As it was given, with the address in place of the name.
        host: The name, for the Host header and the certificate.
        netloc: The name with the port, as it stands in the URL.
    """

    url: str
    host: str
    netloc: str


def checked_url(url: str) -> str:
    """A URL that could be a target.

    Raises:
        ValueError: it could not; says why.
    """
    try:
        parts = urlsplit(url)
        port = parts.port
    except ValueError as error:
        msg = "must be an address like https://example.com/hook"
        raise ValueError(msg) from error
    if parts.scheme not in {"http", "https"} or not parts.hostname or port == 0:
        msg = "must be an address like https://example.com/hook"
        raise ValueError(msg)
    if parts.username is not None or parts.password is not None:
        msg = "must not contain a user or password: the signature proves who sends"
        raise ValueError(msg)
    if any(character.isspace() or not character.isprintable() for character in url):
        msg = "must not contain spaces"
        raise ValueError(msg)
    if not url.isascii():
        msg = "must be written in ASCII (punycode and percent signs)"
        raise ValueError(msg)
    return url


async def resolve(host: str, port: int) -> Sequence[IpAddress]:
    """All addresses of a name.

    Raises:
        TargetUnknownError: it has none.
    """
    loop = asyncio.get_running_loop()
    try:
        found = await loop.getaddrinfo(host, port, type=socket.SOCK_STREAM)
    except (OSError, UnicodeError) as error:
        raise TargetUnknownError(f"The name {host} leads nowhere ({error}).") from error
    return [ipaddress.ip_address(str(entry[4][0]).partition("%")[0]) for entry in found]


async def admit(url: str, allowed: Sequence[IpNetwork], resolve_name: Resolve = resolve) -> Target:
    """Check where a URL leads, now.

    Args:
        url: What `checked_url` let through.
        allowed: Private networks that may be reached.
        resolve_name: Gives the addresses of a name.

    Returns:
        The target with one of its addresses in place of its name, so that nobody can change
        what the name means between this check and the connection.

    Raises:
        TargetRefusedError: one of its addresses is inside and not allowed, or is public and the
            URL is not HTTPS.
        TargetUnknownError: its name leads nowhere.
    """
    parts = urlsplit(url)
    host = parts.hostname or ""
    port = parts.port or (443 if parts.scheme == "https" else 80)
    addresses = await resolve_name(host, port)
    if not addresses:
        raise TargetUnknownError(f"The name {host} leads nowhere.")
    for address in addresses:
        _refuse(address, parts.scheme, allowed)
    first = addresses[0]
    literal = f"[{first}]" if first.version == 6 else str(first)
    pinned = parts._replace(netloc=f"{literal}:{port}", fragment="").geturl()
    return Target(url=pinned, host=host, netloc=parts.netloc)


def _refuse(address: IpAddress, scheme: str, allowed: Sequence[IpNetwork]) -> None:
    real = _unwrapped(address)
    if any(real.version == network.version and real in network for network in allowed):
        return
    if not real.is_global or real.is_multicast:
        raise TargetRefusedError(
            f"{real} is inside a private network or this computer. Add it to "
            "webhooks.allowed_networks in the configuration, if you trust it."
        )
    if scheme != "https":
        raise TargetRefusedError(f"{real} is a public address: use https.")


def _unwrapped(address: IpAddress) -> IpAddress:
    """The IPv4 address in an IPv6 one that only carries it."""
    if isinstance(address, IPv6Address):
        if address.ipv4_mapped is not None:
            return address.ipv4_mapped
        if address.sixtofour is not None:
            return address.sixtofour
        if address in NAT64:
            return IPv4Address(int(address) & 0xFFFFFFFF)
    return address
