"""The files of certificate and key that the settings mean."""

from __future__ import annotations

import socket
import ssl
from dataclasses import dataclass
from pathlib import Path

from server.access.addresses import ANY, network_address
from server.config.settings import Settings
from server.tls.errors import CertificateError
from server.tls.places import FOLDER
from server.tls.private import require_private


@dataclass(frozen=True, slots=True)
class TlsFiles:
    """What the web server loads.

    Attributes:
        certificate: PEM, with its chain.
        key: PEM.
        fingerprint: Of the own authority's root; None for given files.
    """

    certificate: Path
    key: Path
    fingerprint: str | None = None


def tls_files(settings: Settings) -> TlsFiles | None:
    """Certificate and key; None for plain http. Of the own authority always a new certificate.

    Raises:
        CertificateError: they cannot be used.
        ExposedKeyError: others can read the key.
    """
    tls = settings.tls
    if tls.mode == "own":
        # loaded only here: it takes a tenth of a second
        from server.tls.authority import Authority  # noqa: PLC0415

        authority = Authority(settings.storage.data_dir / FOLDER, _single_labels(settings))
        certificate, key = authority.issue(own_names(settings))
        return TlsFiles(certificate, key, authority.fingerprint())
    if tls.mode == "off" or tls.certificate is None or tls.key is None:
        return None
    try:
        require_private(tls.key)
        ssl.create_default_context(ssl.Purpose.CLIENT_AUTH).load_cert_chain(
            tls.certificate, tls.key
        )
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise CertificateError(
            f"{tls.certificate} with {tls.key} cannot be used: {reason}."
        ) from error
    return TlsFiles(tls.certificate, tls.key)


def own_names(settings: Settings) -> list[str]:
    """Names and addresses under which browsers reach this server."""
    host = settings.server.host
    names = ["localhost", "127.0.0.1", "::1", *_single_labels(settings)]
    machine = socket.gethostname().split(".")[0].lower()
    names += [f"{machine}.local", f"{machine}.home.arpa", f"{machine}.internal"]
    address = network_address() if host in ANY else host
    if address is not None:
        names.append(address)
    return list(dict.fromkeys(names))


def _single_labels(settings: Settings) -> tuple[str, ...]:
    machine = socket.gethostname().split(".")[0].lower()
    return tuple(dict.fromkeys((machine, *settings.access.host_names)))
