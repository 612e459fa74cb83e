"""Errors of https.

CertificateError
└── ExposedKeyError   others can read the private key
"""

from __future__ import annotations

from server.config.errors import ConfigurationError


class CertificateError(ConfigurationError):
    """The certificate or its key cannot be used."""

    code = "certificate"
    title = "The certificate cannot be used"
    remedy = "Check tls.certificate and tls.key, or let PlugPilot make its own: --tls."


class ExposedKeyError(CertificateError):
    """Others can read the private key."""

    code = "exposed_key"
    title = "Others can read the private key"
    remedy = "Take their right to read the file away: chmod 600 FILE."
