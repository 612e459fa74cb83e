"""Headers that every answer has, unless its route brings its own."""

from __future__ import annotations

from starlette.datastructures import Headers, MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from server.api.gate.caller import scheme_of
from server.api.gate.origin import host_name, is_own_host

ALWAYS = {
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "X-Frame-Options": "SAMEORIGIN",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Permissions-Policy": "camera=(), microphone=(), geolocation=(), payment=(), usb=(), "
    "serial=(), screen-wake-lock=(self), gamepad=(self), fullscreen=(self), "
    "publickey-credentials-get=(self), publickey-credentials-create=(self)",
    "Content-Security-Policy": "default-src 'none'; frame-ancestors 'none'; base-uri 'none'; "
    "form-action 'none'",
    "Cache-Control": "no-store",
}
"""What is not a page must not be able to do anything when a browser opens it all the same."""

DAY_S = 86_400


class SecurityHeaders:
    """Puts them on. The outermost part of the application, so that no answer goes without."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one request."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return

        async def with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                for name, value in ALWAYS.items():
                    headers.setdefault(name, value)
                age = _insist_on_https(scope)
                if age is not None:
                    headers["Strict-Transport-Security"] = f"max-age={age}"
            await send(message)

        await self._app(scope, receive, with_headers)


def _insist_on_https(scope: Scope) -> int | None:
    """How long the browser shall insist on https [s]; None not to speak of it.

    Only where somebody asked for it, and for a name that can have a certificate of a public
    authority: an address or a name of the home network cannot.
    """
    days = int(scope["app"].state.services.settings.access.hsts_days)
    host = Headers(scope=scope).get("host", "")
    if days == 0 or scheme_of(scope) != "https":
        return None
    name = host_name(host)
    if name is None or is_own_host(name, ()):
        return None
    return days * DAY_S
