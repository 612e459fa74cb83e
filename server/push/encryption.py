"""Encrypts what a push service carries, so that only the browser can read it (RFC 8291)."""

from __future__ import annotations

import secrets

from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.hazmat.primitives.ciphers.aead import AESGCM
from cryptography.hazmat.primitives.hashes import SHA256
from cryptography.hazmat.primitives.kdf.hkdf import HKDF
from cryptography.hazmat.primitives.serialization import Encoding, PublicFormat

SALT_BYTES = 16
RECORD_BYTES = 4096
LARGEST_PLAIN = 3993
"""Of one record, as every push service takes it (RFC 8291, section 4)."""

_CURVE = ec.SECP256R1()
_LAST_RECORD = b"\x02"


def encrypt(
    plain: bytes,
    public_key: bytes,
    auth_secret: bytes,
    *,
    sender: ec.EllipticCurvePrivateKey | None = None,
    salt: bytes | None = None,
) -> bytes:
    """Encrypt a message in the content coding ``aes128gcm`` (RFC 8188), in one record.

    Args:
        plain: At most `LARGEST_PLAIN` bytes.
        public_key: Of the browser: a point of P-256, uncompressed, 65 bytes.
        auth_secret: Of the browser, 16 bytes.
        sender: A key for this message alone; made when there is none.
        salt: 16 bytes for this message alone; made when there are none.

    Raises:
        ValueError: the message is too long, or the key is no point of the curve.
    """
    if len(plain) > LARGEST_PLAIN:
        msg = f"a message of {len(plain)} bytes is too long"
        raise ValueError(msg)
    browser = ec.EllipticCurvePublicKey.from_encoded_point(_CURVE, public_key)
    sender = sender or ec.generate_private_key(_CURVE)
    salt = salt or secrets.token_bytes(SALT_BYTES)
    own = sender.public_key().public_bytes(Encoding.X962, PublicFormat.UncompressedPoint)

    shared = sender.exchange(ec.ECDH(), browser)
    key_info = b"WebPush: info\0" + public_key + own
    material = _derive(shared, auth_secret, key_info, 32)
    key = _derive(material, salt, b"Content-Encoding: aes128gcm\0", 16)
    nonce = _derive(material, salt, b"Content-Encoding: nonce\0", 12)

    header = salt + RECORD_BYTES.to_bytes(4, "big") + len(own).to_bytes(1, "big") + own
    return header + AESGCM(key).encrypt(nonce, plain + _LAST_RECORD, None)


def is_public_key(point: bytes) -> bool:
    """Whether bytes are an uncompressed point of P-256."""
    try:
        ec.EllipticCurvePublicKey.from_encoded_point(_CURVE, point)
    except ValueError:
        return False
    return len(point) == 65


def _derive(secret: bytes, salt: bytes, info: bytes, length: int) -> bytes:
    return HKDF(SHA256(), length, salt, info).derive(secret)
