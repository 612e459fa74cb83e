"""https: which certificate the server shows, and the authority that makes it where there is none.

The authority is in `server.tls.authority`, which is loaded only where one is used.
"""

from server.tls.errors import CertificateError, ExposedKeyError
from server.tls.files import TlsFiles, tls_files
from server.tls.places import FOLDER, ROOT_FILE

__all__ = ["FOLDER", "ROOT_FILE", "CertificateError", "ExposedKeyError", "TlsFiles", "tls_files"]
