"""Makes the station drivers from their settings. Nothing is connected yet."""

from __future__ import annotations

from typing import TypeVar

from drivers.station.evcc import EvccStation
from drivers.station.goe import GoeStation
from drivers.station.http import HttpStation
from drivers.station.managed import ManagedStation
from drivers.station.memory import StationMemory
from drivers.station.openevse import OpenevseStation
from drivers.station.protocol import StationDriver
from drivers.station.settings import StationGroups
from drivers.station.shelly import ShellyStation

G = TypeVar("G")


def make_openevse(groups: StationGroups, memory: StationMemory) -> StationDriver:
    """An OpenEVSE."""
    return OpenevseStation(_need(groups.openevse, "openevse"), memory)


def make_evcc(groups: StationGroups, memory: StationMemory) -> StationDriver:
    """An evcc alone: good for starting and stopping, never a proof of no load."""
    return EvccStation(_need(groups.evcc, "evcc"), memory)


def make_goe(groups: StationGroups, memory: StationMemory) -> StationDriver:
    """A go-e charger."""
    return GoeStation(_need(groups.goe, "goe"), memory)


def make_shelly(groups: StationGroups) -> StationDriver:
    """A Shelly relay."""
    return ShellyStation(_need(groups.shelly, "shelly"))


def make_http(groups: StationGroups) -> StationDriver:
    """A station that the configuration describes."""
    return HttpStation(_need(groups.http, "http"))


def make_ocpp(groups: StationGroups, memory: StationMemory) -> StationDriver:
    """A station that connects by OCPP 1.6-J."""
    # imported late: its library costs every start a fifth of a second, and few speak OCPP
    from drivers.station.ocpp16 import OcppStation  # noqa: PLC0415

    return OcppStation(_need(groups.ocpp, "ocpp"), memory)


def manage(
    manager: str, station: StationDriver, groups: StationGroups, memory: StationMemory
) -> StationDriver:
    """A station with an energy manager before it.

    Raises:
        ValueError: there is no such manager.
    """
    if manager != "evcc":
        msg = f"There is no energy manager {manager!r} in this version; there is: evcc."
        raise ValueError(msg)
    settings = _need(groups.evcc, "evcc")
    return ManagedStation(EvccStation(settings, memory), station, lets_go_s=settings.lets_go_s)


def _need(group: G | None, name: str) -> G:
    if group is None:
        msg = f"The settings in [station.{name}] are missing."
        raise ValueError(msg)
    return group
