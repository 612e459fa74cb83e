"""The WebSocket that the station connects to."""

from __future__ import annotations

import base64
import hmac
from collections.abc import Awaitable, Callable
from http import HTTPStatus
from urllib.parse import unquote, urlsplit

from pydantic import SecretStr
from websockets.asyncio.server import Server, ServerConnection, serve
from websockets.http11 import Request, Response
from websockets.typing import Subprotocol

from drivers.station.errors import StationUnreachableError
from drivers.station.settings import OcppSettings

PROTOCOL = Subprotocol("ocpp1.6")
LONGEST_MESSAGE = 65536
PING_S = 5.0


async def listen(
    settings: OcppSettings, talk: Callable[[ServerConnection], Awaitable[None]]
) -> Server:
    """Wait for the station to connect.

    Args:
        settings: Where, and for which station.
        talk: Called for each connection of that station.

    Raises:
        StationUnreachableError: the port is taken.
    """

    def admit(connection: ServerConnection, request: Request) -> Response | None:
        identity = unquote(urlsplit(request.path).path.rpartition("/")[2])
        if identity != settings.charge_point:
            return connection.respond(HTTPStatus.NOT_FOUND, "Unknown charge point.\n")
        if not _may_enter(settings, request.headers.get("Authorization", "")):
            return connection.respond(HTTPStatus.UNAUTHORIZED, "Wrong AuthorizationKey.\n")
        return None

    try:
        return await serve(
            talk,
            settings.host,
            settings.port,
            subprotocols=[PROTOCOL],
            process_request=admit,
            max_size=LONGEST_MESSAGE,
            ping_interval=PING_S,
            ping_timeout=PING_S,
            close_timeout=settings.timeout_s,
        )
    except OSError as error:
        raise StationUnreachableError(
            f"Port {settings.port} for the charging station cannot be used ({error.strerror}). "
            "Stop the other program that listens there, or set station.ocpp.port."
        ) from error


def _may_enter(settings: OcppSettings, given: str) -> bool:
    secret: SecretStr | None = settings.password
    if secret is None:
        return True
    login = f"{settings.charge_point}:{secret.get_secret_value()}".encode()
    expected = "Basic " + base64.b64encode(login).decode()
    return hmac.compare_digest(given.encode(), expected.encode())
