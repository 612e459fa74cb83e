"""https: the own authority as browsers check it, given files, and the real server with it."""

from __future__ import annotations

import ssl
from pathlib import Path

import httpx
import pytest
from cryptography import x509
from cryptography.x509.verification import PolicyBuilder, Store, VerificationError

from server.config.settings import Settings
from server.config.storage import StorageSettings
from server.config.tls import TlsSettings
from server.tls import ROOT_FILE, CertificateError, ExposedKeyError, tls_files
from server.tls.authority import Authority
from tests.support.process import serving


def _verify(folder: Path, name: str) -> None:
    """Check the server's certificate as a browser does."""
    root = x509.load_pem_x509_certificate((folder / ROOT_FILE).read_bytes())
    leaf = x509.load_pem_x509_certificate((folder / "server.crt").read_bytes())
    verifier = PolicyBuilder().store(Store([root])).build_server_verifier(x509.DNSName(name))
    verifier.verify(leaf, [])


def test_the_authority_vouches_for_names_of_the_home_only(tmp_path: Path) -> None:
    authority = Authority(tmp_path, ("robot",))
    authority.issue(["robot", "robot.local", "192.168.1.20", "bank.example", "198.51.100.1"])
    leaf = x509.load_pem_x509_certificate((tmp_path / "server.crt").read_bytes())
    names = leaf.extensions.get_extension_for_class(x509.SubjectAlternativeName).value
    assert names.get_values_for_type(x509.DNSName) == ["robot", "robot.local"]
    assert [str(a) for a in names.get_values_for_type(x509.IPAddress)] == ["192.168.1.20"]
    _verify(tmp_path, "robot.local")
    with pytest.raises(VerificationError):
        _verify(tmp_path, "bank.example")


def test_the_root_stays_and_the_servers_certificate_is_new_at_every_start(tmp_path: Path) -> None:
    first = Authority(tmp_path)
    first.issue(["localhost"])
    before = (tmp_path / ROOT_FILE).read_bytes(), (tmp_path / "server.crt").read_bytes()
    second = Authority(tmp_path)
    second.issue(["localhost"])
    assert second.fingerprint() == first.fingerprint()
    assert (tmp_path / ROOT_FILE).read_bytes() == before[0]
    assert (tmp_path / "server.crt").read_bytes() != before[1]
    for name in ("root.key", "server.key"):
        assert (tmp_path / name).stat().st_mode & 0o777 == 0o600


def test_a_key_that_others_can_read_is_refused(tmp_path: Path) -> None:
    Authority(tmp_path)
    (tmp_path / "root.key").chmod(0o640)
    with pytest.raises(ExposedKeyError, match=r"root\.key"):
        Authority(tmp_path)


def test_a_damaged_authority_is_told_and_left_alone(tmp_path: Path) -> None:
    Authority(tmp_path)
    (tmp_path / "root.key").write_text("no key")
    with pytest.raises(CertificateError):
        Authority(tmp_path)
    assert (tmp_path / "root.key").read_text() == "no key"


def _with_files(tmp_path: Path, certificate: str, key: str) -> Settings:
    return Settings(
        storage=StorageSettings(data_dir=tmp_path),
        tls=TlsSettings(mode="files", certificate=tmp_path / certificate, key=tmp_path / key),
    )


def test_given_files_are_checked_before_the_start(tmp_path: Path) -> None:
    Authority(tmp_path).issue(["localhost"])
    files = tls_files(_with_files(tmp_path, "server.crt", "server.key"))
    assert files is not None
    assert files.fingerprint is None
    for certificate, key in (
        ("server.crt", "root.key"),  # not its key
        ("missing.crt", "server.key"),
        ("server.key", "server.key"),
    ):
        with pytest.raises(CertificateError):
            tls_files(_with_files(tmp_path, certificate, key))
    (tmp_path / "server.key").chmod(0o644)
    with pytest.raises(ExposedKeyError):
        tls_files(_with_files(tmp_path, "server.crt", "server.key"))


def test_files_must_be_named() -> None:
    with pytest.raises(ValueError, match=r"tls\.certificate"):
        TlsSettings(mode="files")


def test_the_real_server_speaks_https_with_one_option(tmp_path: Path) -> None:
    with serving("--tls", data_dir=tmp_path) as server:
        assert server.url.startswith("https://127.0.0.1:")
        trust = ssl.create_default_context(cafile=str(tmp_path / "tls" / ROOT_FILE))
        with httpx.Client(verify=trust, trust_env=False) as client:
            health = client.get(f"{server.url}/api/v1/health")
            assert health.status_code == 200
            assert "strict-transport-security" not in health.headers
            root = client.get(f"{server.url}/root.crt")
            assert root.content == (tmp_path / "tls" / ROOT_FILE).read_bytes()
        with pytest.raises(httpx.RemoteProtocolError):
            httpx.get(server.url.replace("https", "http"), trust_env=False)
