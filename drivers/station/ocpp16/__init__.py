"""A station that speaks OCPP 1.6-J, with this computer as its central system."""

from drivers.station.ocpp16.driver import OcppStation

__all__ = ["OcppStation"]
