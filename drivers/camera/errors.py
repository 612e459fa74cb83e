"""Errors of cameras.

CameraError
└── CameraTimeoutError   no new frame in time
"""

from __future__ import annotations


class CameraError(Exception):
    """The camera cannot deliver; the message says why and what to do."""


class CameraTimeoutError(CameraError):
    """No new frame arrived in time."""
