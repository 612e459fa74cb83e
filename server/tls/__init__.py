"""https: which certificate the server shows, and the authority that makes it where there is none.

See the README of server/access for what is installed where.
"""

from server.tls.authority import ROOT_FILE, Authority
from server.tls.errors import CertificateError, ExposedKeyError
from server.tls.files import TlsFiles, tls_files

__all__ = [
    "ROOT_FILE",
    "Authority",
    "CertificateError",
    "ExposedKeyError",
    "TlsFiles",
    "tls_files",
]
