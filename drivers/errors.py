"""Errors of choosing a driver.

UnknownDriverError   there is no driver of that name
"""

from __future__ import annotations


class UnknownDriverError(Exception):
    """There is no driver of that name; the message lists those that there are."""
