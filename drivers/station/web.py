"""Speaking HTTP with a device that may hang, lie or be somebody else."""

from __future__ import annotations

import asyncio
import logging
from dataclasses import dataclass
from typing import TypedDict, TypeVar

import httpx
from pydantic import BaseModel, ConfigDict, JsonValue, ValidationError

from drivers.station.errors import (
    StationAnswerError,
    StationLoginError,
    StationNotOpenError,
    StationRefusedError,
    StationSilentError,
    StationUnreachableError,
)

# It tells every request, and a station is asked ten times a second while the plug comes out.
logging.getLogger("httpx").setLevel(logging.WARNING)

LARGEST_ANSWER = 1_000_000
MARGIN_S = 0.5
"""For what is done between the calls."""
ATTEMPTS = 2
"""A connection that was kept open may have been dropped by the device since."""


class Answer(BaseModel):
    """Base of the models of answers: no conversions, and no NaN."""

    model_config = ConfigDict(frozen=True, strict=True, allow_inf_nan=False)


A = TypeVar("A", bound=BaseModel)


@dataclass(frozen=True, slots=True)
class Reply:
    """What came back.

    Attributes:
        asked_s: When the request was sent, event loop time [s]; what it says is no older.
        content: The body.
    """

    asked_s: float
    content: bytes


class CallBounds(TypedDict):
    """The part of the capabilities that follows from the time limit of one call [s]."""

    reads_within_s: float
    acts_within_s: float


class WebDevice:
    """One device, spoken to by HTTP. Calls may be repeated once: all of ours can be.

    Args:
        name: What to call it in messages.
        url: Its address.
        timeout_s: Longest time of a whole call [s].
        auth: How to log in.
    """

    def __init__(
        self, name: str, url: str, timeout_s: float, auth: httpx.Auth | None = None
    ) -> None:
        self.name = name
        self.url = url
        self._timeout_s = timeout_s
        self._auth = auth
        self._client: httpx.AsyncClient | None = None

    @property
    def is_open(self) -> bool:
        """Between open() and close()."""
        return self._client is not None

    def bounds(self, reading_calls: int, acting_calls: int) -> CallBounds:
        """How long snapshot() and the other calls of a driver take at most.

        Args:
            reading_calls: Calls that snapshot() makes.
            acting_calls: Calls that the longest of the others makes.
        """
        return CallBounds(
            reads_within_s=reading_calls * self._timeout_s + MARGIN_S,
            acts_within_s=acting_calls * self._timeout_s + MARGIN_S,
        )

    def open(self) -> None:
        """Make ready; no connection is made yet."""
        if self._client is None:
            self._client = httpx.AsyncClient(
                base_url=self.url,
                auth=self._auth,
                timeout=self._timeout_s,
                trust_env=False,
                # Reading all certificates takes a while, and plain HTTP needs none.
                verify=self.url.startswith("https:"),
            )

    async def close(self) -> None:
        """Drop all connections. Safe to call twice."""
        client, self._client = self._client, None
        if client is not None:
            await client.aclose()

    async def read(self, model: type[A], path: str) -> tuple[A, float]:
        """GET something and check it; returns it with the time when it was asked for [s].

        Raises:
            StationError: one of its kinds; see drivers/station/errors.py.
        """
        reply = await self.call("GET", path)
        return self.parse(model, reply.content), reply.asked_s

    def parse(self, model: type[A], content: bytes | str) -> A:
        """Make a checked answer of a body.

        Raises:
            StationAnswerError: it is not one.
        """
        try:
            return model.model_validate_json(content)
        except ValidationError as error:
            first = error.errors()[0]
            place = ".".join(map(str, first["loc"])) or "the answer"
            raise StationAnswerError(
                f"{self.name} at {self.url} answered something else than expected: {place}: "
                f"{first['msg']}. Check that its address is right and its firmware up to date."
            ) from None

    async def call(self, method: str, path: str, *, json: JsonValue = None) -> Reply:
        """Send one request.

        Raises:
            StationError: one of its kinds; see drivers/station/errors.py.
        """
        if self._client is None:
            raise StationNotOpenError(f"{self.name} is not connected: open it first.")
        try:
            async with asyncio.timeout(self._timeout_s):
                return await self._call(self._client, method, path, json)
        except (TimeoutError, httpx.TimeoutException):
            raise StationSilentError(
                f"{self.name} at {self.url} did not answer within {self._timeout_s:g} s. "
                "Check its power and the network."
            ) from None

    async def _call(
        self, client: httpx.AsyncClient, method: str, path: str, json: JsonValue
    ) -> Reply:
        for attempt in range(1, ATTEMPTS + 1):
            asked_s = asyncio.get_running_loop().time()
            try:
                async with client.stream(method, path, json=json) as response:
                    content = await self._body(response)
            except httpx.TimeoutException:
                raise
            except (httpx.HTTPError, httpx.StreamError) as error:
                if attempt == ATTEMPTS or isinstance(error, httpx.ConnectError):
                    raise StationUnreachableError(
                        f"{self.name} cannot be reached at {self.url} "
                        f"({str(error) or type(error).__name__}). "
                        "Check its power, the network and its address in the configuration."
                    ) from error
                continue
            self._check_status(response, method, path, content)
            return Reply(asked_s, content)
        raise AssertionError("the last attempt ends the loop")

    async def _body(self, response: httpx.Response) -> bytes:
        content = bytearray()
        async for piece in response.aiter_bytes():
            content += piece
            if len(content) > LARGEST_ANSWER:
                raise StationAnswerError(
                    f"{self.name} at {self.url} answers without an end. Check its address."
                )
        return bytes(content)

    def _check_status(
        self, response: httpx.Response, method: str, path: str, content: bytes
    ) -> None:
        status = response.status_code
        if status in {401, 403}:
            raise StationLoginError(
                f"{self.name} at {self.url} does not let us in (HTTP {status}). "
                "Check user and password in the configuration."
            )
        if not response.is_success:
            said = content[:80].decode("utf-8", "replace").strip()
            raise StationRefusedError(
                f"{self.name} at {self.url} refused {method} {path} (HTTP {status}: {said}). "
                "Check its address, its settings and its firmware."
            )
