"""An invitation as its address and its QR code."""

from __future__ import annotations

from datetime import datetime

import segno
from fastapi import Request

from server.access.addresses import ANY, is_loopback, pairing_address, reachable_host
from server.api.gate.caller import scheme_of
from server.api.gate.origin import LOOPBACK_NAMES, host_name, host_port
from server.config.server import ServerSettings
from server.schema.access import IssuedInvitation


def issued(
    request: Request, settings: ServerSettings, secret: str, expires_at: datetime
) -> IssuedInvitation:
    """What to show to whoever is invited.

    The address is the one that the inviting page has itself: whoever reaches it under a name gives
    that name on. Only a page on the machine itself gives on the machine's address in its network.
    """
    host = request.headers.get("host", "")
    reachable = host_name(host) not in LOOPBACK_NAMES
    if not reachable and (settings.host in ANY or not is_loopback(settings.host)):
        port = host_port(host)
        host = reachable_host(settings.host) + ("" if port is None else f":{port}")
        reachable = host_name(host) not in LOOPBACK_NAMES
    page = f"{scheme_of(request.scope)}://{host}"
    origin = request.headers.get("origin", "")
    if origin.endswith(f"//{host}"):
        page = origin
    address = pairing_address(page, secret)
    return IssuedInvitation(
        address=address,
        qr=segno.make(address, error="m").svg_data_uri(border=4, light="#fff"),
        reachable=reachable,
        expires_at=expires_at,
    )
