"""evcc: the energy manager in front of a station."""

from drivers.station.evcc.driver import EvccStation

__all__ = ["EvccStation"]
