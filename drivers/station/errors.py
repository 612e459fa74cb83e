"""Errors of charging stations.

StationError
└── StationUnsupportedError   this kind of station cannot do that
"""

from __future__ import annotations


class StationError(Exception):
    """The station did not answer, or answered something that makes no sense."""


class StationUnsupportedError(StationError):
    """This kind of station cannot do that; see its capabilities."""
