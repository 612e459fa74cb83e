"""The settings of each kind of station: where it is and how it is to be spoken to."""

from __future__ import annotations

import json
from typing import Annotated, Literal, Self
from urllib.parse import urlsplit

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, SecretStr, model_validator

from drivers.station.protocol import PilotState


class Group(BaseModel):
    """Base of all groups: immutable, and a misspelt name is an error."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


def _web_address(url: str) -> str:
    parts = urlsplit(url)
    if parts.scheme not in {"http", "https"} or not parts.hostname:
        msg = "must be an address like http://192.168.1.20"
        raise ValueError(msg)
    if parts.username is not None or parts.password is not None:
        msg = "must not contain a password; there are settings of their own for user and password"
        raise ValueError(msg)
    if parts.query or parts.fragment:
        msg = "must end before any ? or #"
        raise ValueError(msg)
    return url.rstrip("/")


def _json_text(text: str) -> str:
    try:
        json.loads(text)
    except ValueError as error:
        msg = f"must be JSON: {error}"
        raise ValueError(msg) from error
    return text


WebAddress = Annotated[str, AfterValidator(_web_address)]
Seconds = Annotated[float, Field(gt=0, le=3600)]
RequestPath = Annotated[str, Field(pattern=r"^/\S*$", max_length=500)]
AnswerPath = Annotated[str, Field(pattern=r"^[^.\[\]\s]+(\.[^.\[\]\s]+|\[\d+\])*$", max_length=200)]


class WebSettings(Group):
    """How to reach a device by HTTP."""

    url: WebAddress = Field(description="Address of the device, such as http://192.168.1.20")
    timeout_s: Annotated[float, Field(gt=0, le=3)] = Field(
        2.0, description="A whole call takes no longer, one repetition included"
    )


class OpenevseSettings(WebSettings):
    """An OpenEVSE with its WiFi module."""

    user: str = Field("admin", description="Only used with a password")
    password: SecretStr | None = Field(None, description="As set in its web page, if any")
    push: bool = Field(True, description="Also listen to its WebSocket, to see load at once")


class EvccSettings(WebSettings):
    """An evcc: the energy manager in front of a station."""

    loadpoint: Annotated[int, Field(ge=1, le=99)] = Field(1, description="Counted from 1")
    interval_s: Seconds = Field(
        30.0, description="The `interval` of evcc: what it says of the station may be this old"
    )
    start_mode: Literal["now", "minpv", "pv"] = Field(
        "now", description="Mode for charging when evcc was off before"
    )
    lets_go_s: Seconds = Field(
        10.0, description="In mode off it must have stopped enabling the station within this time"
    )


class GoeSettings(WebSettings):
    """A go-e charger with its local API v2 switched on."""


class ShellySettings(WebSettings):
    """A Shelly of generation 2 or later that feeds a station, or its contactor."""

    switch: Annotated[int, Field(ge=0, le=7)] = 0
    password: SecretStr | None = Field(None, description="The user is always admin")
    car_input: Annotated[int, Field(ge=0, le=7)] | None = Field(
        None, description="Input that is on while a car is connected; without one nobody knows"
    )


class Command(Group):
    """A request that makes the station do something."""

    path: RequestPath
    method: Literal["GET", "POST", "PUT", "PATCH", "DELETE"] = "POST"
    body: Annotated[str, AfterValidator(_json_text)] | None = Field(
        None, description="JSON text to send"
    )


class NumberPlace(Group):
    """Where a number is in an answer."""

    path: AnswerPath = Field(description="As in data.phases[0].current")
    factor: Annotated[float, Field(ge=-1e6, le=1e6)] = Field(
        1.0, description="Makes A, W or Wh of it"
    )


class PilotPlace(Group):
    """Where the state of the station is in an answer, and what its values mean."""

    path: AnswerPath
    states: dict[str, PilotState] = Field(
        description="Each value as text, with the state A to F that it means", min_length=2
    )


class HttpSettings(WebSettings):
    """Any station with a JSON API: addresses and places in its answer."""

    name: Annotated[str, Field(min_length=1, max_length=60)] = "Charging station"
    login: Literal["none", "basic", "digest", "bearer"] = "none"
    user: str = ""
    password: SecretStr | None = Field(None, description="Password, or token with login bearer")
    status: RequestPath = Field(description="What to GET for the state")
    pilot: PilotPlace
    currents: tuple[NumberPlace, ...] = Field(min_length=1, max_length=3)
    power: NumberPlace
    energy: NumberPlace | None = Field(None, description="Energy of this session")
    enabled: AnswerPath | None = Field(None, description="A truth value; else C means enabled")
    contactor: AnswerPath | None = Field(None, description="A truth value; else C means closed")
    locked: AnswerPath | None = Field(None, description="A truth value")
    clock: AnswerPath | None = Field(None, description="A value that changes every second")
    start: Command | None = None
    stop: Command | None = None
    unlock: Command | None = None

    @model_validator(mode="after")
    def _is_complete(self) -> Self:
        if (self.start is None) != (self.stop is None):
            msg = "start and stop go together: give both or none"
            raise ValueError(msg)
        if (self.login != "none") != (self.password is not None):
            msg = "a login needs a password, and a password a login"
            raise ValueError(msg)
        return self


class OcppSettings(Group):
    """A station that speaks OCPP 1.6-J and connects to us."""

    host: str = Field("0.0.0.0", description="Address to listen at")  # noqa: S104 - a home network
    port: Annotated[int, Field(ge=0, le=65535)] = 9180
    charge_point: Annotated[str, Field(pattern=r"^[\w.:-]+$", max_length=48)] = Field(
        description="Its identity: it connects to ws://this-computer:port/ocpp/identity"
    )
    password: SecretStr | None = Field(None, description="Its AuthorizationKey, if any")
    connector: Annotated[int, Field(ge=1, le=9)] = 1
    unlocks: bool = Field(False, description="It has a lock that UnlockConnector opens")
    id_tag: Annotated[str, Field(min_length=1, max_length=20)] = "PLUGPILOT"
    timeout_s: Annotated[float, Field(gt=0, le=3)] = 2.0
    clock_tolerance_s: Seconds = Field(
        3.0, description="A message with a time stamp older than this is not news"
    )


class StationGroups(Group):
    """One group for each kind of station; the one in use must be there."""

    openevse: OpenevseSettings | None = None
    evcc: EvccSettings | None = None
    goe: GoeSettings | None = None
    shelly: ShellySettings | None = None
    http: HttpSettings | None = None
    ocpp: OcppSettings | None = None
