"""A certificate authority of one installation, and the certificate that it gives the server.

The root can vouch for nothing but this home's names and private addresses (name constraints,
RFC 5280, 4.2.1.10): a phone that trusts it is not at anybody's mercy should its key be stolen.
"""

from __future__ import annotations

import ipaddress
import os
from datetime import UTC, datetime, timedelta
from pathlib import Path

from cryptography import x509
from cryptography.hazmat.primitives import hashes, serialization
from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.x509.oid import ExtendedKeyUsageOID, NameOID

from server.tls.errors import CertificateError
from server.tls.places import ROOT_FILE
from server.tls.private import require_private

ROOT_KEY_FILE = "root.key"
ROOT_VALID = timedelta(days=3650)
SERVER_VALID = timedelta(days=397)  # browsers take none that is valid for longer
SKEW = timedelta(hours=1)
OWNER_ONLY = 0o600

HOME_NAMES = ("local", "localhost", "home.arpa", "internal")
PRIVATE_NETWORKS = (
    "10.0.0.0/8",
    "172.16.0.0/12",
    "192.168.0.0/16",
    "169.254.0.0/16",
    "127.0.0.0/8",
    "fc00::/7",
    "fe80::/10",
    "::1/128",
)


class Authority:
    """Signs the server's certificates.

    Args:
        folder: Where root and key are kept; made, with both, when there is none.
        names: Further names that it may vouch for. They count only when it is made.

    Raises:
        CertificateError: the files cannot be used or made.
        ExposedKeyError: others can read the key.
    """

    def __init__(self, folder: Path, names: tuple[str, ...] = ()) -> None:
        self._folder = folder
        try:
            folder.mkdir(mode=0o700, parents=True, exist_ok=True)
            if not (folder / ROOT_KEY_FILE).exists():
                self._make(names)
            require_private(folder / ROOT_KEY_FILE)
            key = serialization.load_pem_private_key(
                (folder / ROOT_KEY_FILE).read_bytes(), password=None
            )
            self._root = x509.load_pem_x509_certificate((folder / ROOT_FILE).read_bytes())
        except (OSError, ValueError) as error:
            raise CertificateError(f"{folder} does not hold an authority: {error}.") from error
        if not isinstance(key, ec.EllipticCurvePrivateKey):
            raise CertificateError(f"{folder / ROOT_KEY_FILE} holds another kind of key.")
        self._key = key

    def fingerprint(self) -> str:
        """SHA-256 of the root, to compare by eye with what a phone shows."""
        return self._root.fingerprint(hashes.SHA256()).hex(":").upper()

    def issue(self, names: list[str]) -> tuple[Path, Path]:
        """A certificate for a server that is reached under these names and addresses.

        Returns:
            Its file, with the root behind it, and the file of its key.
        """
        key = ec.generate_private_key(ec.SECP256R1())
        now = datetime.now(UTC)
        vouched = [name for name in names if self._may_vouch(name)]
        certificate = (
            x509.CertificateBuilder()
            .subject_name(_name("PlugPilot"))
            .issuer_name(self._root.subject)
            .public_key(key.public_key())
            .serial_number(x509.random_serial_number())
            .not_valid_before(now - SKEW)
            .not_valid_after(min(now + SERVER_VALID, self._root.not_valid_after_utc))
            .add_extension(
                x509.SubjectAlternativeName(list(map(_general, vouched))), critical=False
            )
            .add_extension(x509.BasicConstraints(ca=False, path_length=None), critical=True)
            .add_extension(x509.ExtendedKeyUsage([ExtendedKeyUsageOID.SERVER_AUTH]), critical=False)
            .add_extension(_usage(signs_certificates=False), critical=True)
            .add_extension(
                x509.AuthorityKeyIdentifier.from_issuer_public_key(self._key.public_key()),
                critical=False,
            )
            .sign(self._key, hashes.SHA256())
        )
        paths = self._folder / "server.crt", self._folder / "server.key"
        chain = _pem(certificate) + _pem(self._root)
        paths[0].write_bytes(chain)
        _write_private(paths[1], key)
        return paths

    def _make(self, names: tuple[str, ...]) -> None:
        key = ec.generate_private_key(ec.SECP256R1())
        now = datetime.now(UTC)
        subject = _name(f"PlugPilot {os.urandom(3).hex()}")
        allowed: list[x509.GeneralName] = [x509.DNSName(n) for n in (*HOME_NAMES, *names)]
        allowed += [x509.IPAddress(ipaddress.ip_network(each)) for each in PRIVATE_NETWORKS]
        root = (
            x509.CertificateBuilder()
            .subject_name(subject)
            .issuer_name(subject)
            .public_key(key.public_key())
            .serial_number(x509.random_serial_number())
            .not_valid_before(now - SKEW)
            .not_valid_after(now + ROOT_VALID)
            .add_extension(x509.BasicConstraints(ca=True, path_length=0), critical=True)
            .add_extension(_usage(signs_certificates=True), critical=True)
            .add_extension(x509.NameConstraints(allowed, None), critical=True)
            .add_extension(
                x509.SubjectKeyIdentifier.from_public_key(key.public_key()), critical=False
            )
            .sign(key, hashes.SHA256())
        )
        (self._folder / ROOT_FILE).write_bytes(_pem(root))
        _write_private(self._folder / ROOT_KEY_FILE, key)

    def _may_vouch(self, name: str) -> bool:
        constraints = self._root.extensions.get_extension_for_class(x509.NameConstraints).value
        allowed = constraints.permitted_subtrees or []
        try:
            address = ipaddress.ip_address(name)
        except ValueError:
            return any(
                name == each.value or name.endswith(f".{each.value}")
                for each in allowed
                if isinstance(each, x509.DNSName)
            )
        networks = [each.value for each in allowed if isinstance(each, x509.IPAddress)]
        return any(address in network for network in networks)  # type: ignore[operator]


def _write_private(path: Path, key: ec.EllipticCurvePrivateKey) -> None:
    content = key.private_bytes(
        serialization.Encoding.PEM,
        serialization.PrivateFormat.PKCS8,
        serialization.NoEncryption(),
    )
    path.unlink(missing_ok=True)
    descriptor = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, OWNER_ONLY)
    with os.fdopen(descriptor, "wb") as file:
        file.write(content)


def _pem(certificate: x509.Certificate) -> bytes:
    return certificate.public_bytes(serialization.Encoding.PEM)


def _name(common: str) -> x509.Name:
    return x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, common)])


def _general(name: str) -> x509.GeneralName:
    try:
        return x509.IPAddress(ipaddress.ip_address(name))
    except ValueError:
        return x509.DNSName(name)


def _usage(*, signs_certificates: bool) -> x509.KeyUsage:
    return x509.KeyUsage(
        digital_signature=not signs_certificates,
        key_cert_sign=signs_certificates,
        crl_sign=signs_certificates,
        content_commitment=False,
        key_encipherment=False,
        data_encipherment=False,
        key_agreement=False,
        encipher_only=False,
        decipher_only=False,
    )
