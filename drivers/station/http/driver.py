"""Any station with a JSON API behind the station protocol. It has no hold."""

from __future__ import annotations

import json
from collections.abc import Generator

import httpx
from pydantic import JsonValue, RootModel

from drivers.station.errors import StationAnswerError, StationUnsupportedError
from drivers.station.freshness import ClockWatch
from drivers.station.http.places import Places
from drivers.station.protocol import PilotState, StationCapabilities, StationSnapshot
from drivers.station.settings import Command, HttpSettings, NumberPlace
from drivers.station.web import WebDevice
from drivers.station.web_station import WebStation

SAME_MOMENT_S = 3.0
LOADED = {PilotState.C, PilotState.D}


class Document(RootModel[JsonValue]):
    """Any JSON."""


class _BearerAuth(httpx.Auth):
    def __init__(self, token: str) -> None:
        self._token = token

    def auth_flow(self, request: httpx.Request) -> Generator[httpx.Request, httpx.Response, None]:
        request.headers["Authorization"] = f"Bearer {self._token}"
        yield request


class HttpStation(WebStation):
    """Implements StationDriver.

    Args:
        settings: Addresses, and places in the answer.
    """

    def __init__(self, settings: HttpSettings) -> None:
        super().__init__(
            WebDevice(settings.name, settings.url, settings.timeout_s, _login(settings))
        )
        self._settings = settings
        self._clock = ClockWatch(self.name, SAME_MOMENT_S)

    @property
    def capabilities(self) -> StationCapabilities:
        """What there are commands for."""
        settings = self._settings
        return StationCapabilities(
            switches=settings.stop is not None,
            holds=False,
            unlocks=settings.unlock is not None,
            **self._web.bounds(1, 1),
        )

    async def _look(self) -> None:
        await self.snapshot()

    async def snapshot(self) -> StationSnapshot:
        """Read the station now.

        Raises:
            StationError: see drivers/station/errors.py.
        """
        settings = self._settings
        document, asked_s = await self._web.read(Document, settings.status)
        places = Places(self.name, document.root)
        if settings.clock is not None:
            self._clock.check(places.value(settings.clock), asked_s)
        pilot = self._pilot(places)
        currents_a = [abs(_number(places, place)) for place in settings.currents] + [0.0, 0.0]
        loaded = pilot in LOADED
        return StationSnapshot(
            sampled_at_s=asked_s,
            pilot=pilot,
            enabled=places.truth(settings.enabled) if settings.enabled else loaded,
            held=False,
            contactor_closed=places.truth(settings.contactor) if settings.contactor else loaded,
            connector_locked=places.truth(settings.locked) if settings.locked else None,
            power_w=abs(_number(places, settings.power)),
            currents_a=(currents_a[0], currents_a[1], currents_a[2]),
            session_energy_wh=_number(places, settings.energy) if settings.energy else 0.0,
        )

    async def start(self) -> None:
        """Allow power."""
        await self._do(self._settings.start, "start")

    async def stop(self) -> None:
        """Forbid power; the snapshot shows when it has really gone."""
        await self._do(self._settings.stop, "stop")

    async def hold(self) -> None:
        """The same as stop(); any other client can undo it."""
        await self.stop()

    async def release(self) -> None:
        """Nothing to end: the power stays off until somebody starts it."""

    async def unlock(self) -> None:
        """Open the connector lock."""
        await self._do(self._settings.unlock, "unlock")

    def _pilot(self, places: Places) -> PilotState:
        place = self._settings.pilot
        said = places.text(place.path)
        if said not in place.states:
            raise StationAnswerError(
                f"{self.name} is in the state {said!r:.40}, which pilot.states in [station.http] "
                "does not name. Add it to the configuration."
            )
        return place.states[said]

    async def _do(self, command: Command | None, what: str) -> None:
        if command is None:
            raise StationUnsupportedError(
                f"There is no command to {what} {self.name}. Add one to [station.http]."
            )
        body = json.loads(command.body) if command.body is not None else None
        await self._web.call(command.method, command.path, json=body)


def _number(places: Places, place: NumberPlace) -> float:
    return places.number(place.path) * place.factor


def _login(settings: HttpSettings) -> httpx.Auth | None:
    if settings.password is None:
        return None
    secret = settings.password.get_secret_value()
    if settings.login == "bearer":
        return _BearerAuth(secret)
    kind = httpx.DigestAuth if settings.login == "digest" else httpx.BasicAuth
    return kind(settings.user, secret)
