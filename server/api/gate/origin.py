"""Under which name the server was asked, and which page made the browser ask.

A page from elsewhere can make a browser send requests here. Three things stand against it: it
must name this server as browsers do (Host), its own origin must be this server (Origin,
Sec-Fetch-Site), and the session's cookie does not come along (SameSite=Strict).
"""

from __future__ import annotations

import ipaddress
from collections.abc import Collection, Mapping
from urllib.parse import urlsplit

LOCAL_SUFFIXES = (".localhost", ".local", ".home.arpa", ".internal")
"""Names that nobody can register, so that no stranger's name can be made to lead here."""

LOOPBACK_NAMES = frozenset({"localhost", "127.0.0.1", "::1"})
_DEFAULT_PORTS = {"http": 80, "https": 443}
_OWN_SITES = frozenset({"same-origin", "none"})


def host_name(host: str) -> str | None:
    """The name in a Host header, without port and brackets; None when there is none."""
    try:
        return urlsplit(f"//{host}").hostname
    except ValueError:
        return None


def host_port(host: str) -> int | None:
    """The port in a Host header, if there is one."""
    try:
        return urlsplit(f"//{host}").port
    except ValueError:
        return None


def is_own_host(host: str, names: Collection[str]) -> bool:
    """Whether a Host header can only mean this machine.

    A web page of a stranger can let its name lead to an address in this network (DNS rebinding);
    the browser then takes this server for a part of that page. It cannot do so with an address, a
    name without a dot, or a name under a suffix that is not for sale.
    """
    name = host_name(host)
    if name is None or not _is_plain(host) or "@" in host or "/" in host:
        return False
    return is_address(name) or "." not in name or name.endswith(LOCAL_SUFFIXES) or name in names


def is_address(name: str) -> bool:
    """Whether the name of a host is an IP address."""
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True


def is_own_origin(origin: str, scheme: str, host: str) -> bool:
    """Whether a page of this very server asked.

    Behind a proxy that ends TLS and does not say so, the page's scheme is https and ours http.
    """
    if not _is_plain(origin):
        return False
    try:
        page, own = urlsplit(origin), urlsplit(f"{scheme}://{host}")
        same = (page.hostname, _port(page.scheme, page.port)) == (
            own.hostname,
            _port(own.scheme, own.port),
        )
        if page.scheme == "https" and own.scheme == "http" and not same:
            same = page.netloc == own.netloc
    except ValueError:
        return False
    return same and page.scheme in {own.scheme, "https"} and not page.path


def is_from_elsewhere(headers: Mapping[str, str], scheme: str, *, opens_page: bool) -> bool:
    """Whether a page of somebody else made the browser send this request.

    Args:
        headers: Of the request; names in lower case.
        scheme: "http" or "https".
        opens_page: The request is one that a link on any page may make: it opens our own page.
    """
    origin = headers.get("origin")
    if origin is not None and not is_own_origin(origin, scheme, headers.get("host", "")):
        return True
    site = headers.get("sec-fetch-site")  # browsers send it to https and to localhost only
    if site is None or site in _OWN_SITES:
        return False
    is_link = (
        headers.get("sec-fetch-mode") == "navigate" and headers.get("sec-fetch-dest") == "document"
    )
    return not (opens_page and is_link)


def _is_plain(head: str) -> bool:
    """Whether nothing in it is passed over when it is taken apart, as tabs are in addresses."""
    return head.isascii() and head.isprintable() and " " not in head


def _port(scheme: str, port: int | None) -> int | None:
    return port if port is not None else _DEFAULT_PORTS.get(scheme)
