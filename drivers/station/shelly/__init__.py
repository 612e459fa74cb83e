"""A Shelly relay that feeds a station or its contactor."""

from drivers.station.shelly.driver import ShellyStation

__all__ = ["ShellyStation"]
