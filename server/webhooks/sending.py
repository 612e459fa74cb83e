"""One attempt to deliver: bounded in time and size, without redirects, to a checked address."""

from __future__ import annotations

import asyncio
import logging
import ssl
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Protocol

import httpx

from server.version import VERSION
from server.webhooks.address import (
    IpNetwork,
    Resolve,
    TargetRefusedError,
    TargetUnknownError,
    admit,
    resolve,
)

# It tells every request with its whole address.
logging.getLogger("httpx").setLevel(logging.WARNING)

LARGEST_ANSWER = 65_536


@dataclass(frozen=True, slots=True)
class Outcome:
    """What came of one attempt.

    Attributes:
        status: HTTP status; None without an answer.
        error: What went wrong, in words; None if nothing did.
    """

    status: int | None
    error: str | None

    @property
    def gone(self) -> bool:
        """The receiver wants nothing more, for good."""
        return self.status == httpx.codes.GONE


class Limits(Protocol):
    """What an attempt may do."""

    @property
    def timeout_s(self) -> float:
        """Longest time of one attempt."""
        ...

    @property
    def allowed_networks(self) -> tuple[IpNetwork, ...]:
        """Private networks that may be reached."""
        ...


class Sender(Protocol):
    """Makes attempts."""

    async def send(self, url: str, body: str, headers: Mapping[str, str]) -> Outcome:
        """Make one. Ends within a bounded time and never raises."""
        ...

    async def close(self) -> None:
        """Drop all connections."""
        ...


class HttpSender:
    """Sends over the network.

    Args:
        settings: Gives what is allowed now.
        speed: Seconds of the event loop per second of the world outside.
        resolve_name: Gives the addresses of a name.
        trusted: Whose certificates are believed; those that everybody believes, if not given.
    """

    def __init__(
        self,
        settings: Callable[[], Limits],
        speed: float = 1.0,
        resolve_name: Resolve = resolve,
        trusted: ssl.SSLContext | bool = True,
    ) -> None:
        self._settings = settings
        self._speed = speed
        self._resolve = resolve_name
        self._trusted = trusted
        self._clients: dict[bool, httpx.AsyncClient] = {}

    async def send(self, url: str, body: str, headers: Mapping[str, str]) -> Outcome:
        """POST the body; anything but a 2xx within the time is a failure."""
        return await self.post(url, body.encode(), {"Content-Type": "application/json", **headers})

    async def post(self, url: str, content: bytes, headers: Mapping[str, str]) -> Outcome:
        """The same with bytes of any kind; the headers say which."""
        timeout_s = self._settings().timeout_s
        try:
            async with asyncio.timeout(timeout_s * self._speed):
                return await self._send(url, content, headers)
        except (TimeoutError, httpx.TimeoutException):
            return Outcome(None, f"No answer within {timeout_s:g} s.")
        except (TargetRefusedError, TargetUnknownError) as error:
            return Outcome(None, str(error))
        except (httpx.HTTPError, httpx.StreamError, httpx.InvalidURL) as error:
            return Outcome(None, f"No connection ({str(error) or type(error).__name__}).")

    async def close(self) -> None:
        """Drop all connections."""
        clients, self._clients = self._clients, {}
        for client in clients.values():
            await client.aclose()

    async def _send(self, url: str, content: bytes, headers: Mapping[str, str]) -> Outcome:
        target = await admit(url, self._settings().allowed_networks, self._resolve)
        request_headers = {
            **headers,
            "Host": target.netloc,
            "User-Agent": f"PlugPilot/{VERSION}",
        }
        async with self._client(secure=target.url.startswith("https:")).stream(
            "POST",
            target.url,
            content=content,
            headers=request_headers,
            extensions={"sni_hostname": target.host},
        ) as response:
            size = 0
            async for piece in response.aiter_raw():
                size += len(piece)
                if size > LARGEST_ANSWER:
                    break  # what it says does not matter
        if response.is_success:
            return Outcome(response.status_code, None)
        if response.is_redirect:
            return Outcome(response.status_code, "It redirects, which is not followed.")
        return Outcome(response.status_code, f"It answered {response.status_code}.")

    def _client(self, *, secure: bool) -> httpx.AsyncClient:
        client = self._clients.get(secure)
        if client is None:
            client = self._clients[secure] = httpx.AsyncClient(
                timeout=None,  # the whole attempt has one  # noqa: S113
                follow_redirects=False,
                trust_env=False,  # a proxy would go where we do not
                verify=self._trusted
                if secure
                else False,  # reading all certificates takes a while, and HTTP needs none
                # A connection is for one name; by its address it might serve another one.
                limits=httpx.Limits(max_keepalive_connections=0),
            )
        return client
