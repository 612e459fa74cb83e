"""Any station with a JSON API, described by configuration."""

from drivers.station.http.driver import HttpStation

__all__ = ["HttpStation"]
