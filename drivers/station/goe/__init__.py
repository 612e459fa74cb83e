"""The go-e charger with its local API v2."""

from drivers.station.goe.driver import GoeStation

__all__ = ["GoeStation"]
