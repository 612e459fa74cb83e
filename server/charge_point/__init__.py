"""The robot with its station as one charger, for energy managers such as evcc."""

from server.charge_point.service import ChargePointService

__all__ = ["ChargePointService"]
