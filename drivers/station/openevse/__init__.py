"""The OpenEVSE with its WiFi module."""

from drivers.station.openevse.driver import OpenevseStation

__all__ = ["OpenevseStation"]
