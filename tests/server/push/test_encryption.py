"""What is sent against the example of RFC 8291, and signatures that anybody can check."""

from __future__ import annotations

import base64
from datetime import UTC, datetime

import pytest
from cryptography.exceptions import InvalidTag
from cryptography.hazmat.primitives.asymmetric import ec
from hypothesis import given
from hypothesis import strategies as st
from py_vapid import Vapid02

from server.push.encryption import LARGEST_PLAIN, encrypt, is_public_key
from server.push.vapid import Vapid, new_key
from tests.server.push.browser import PushBrowser


def _bytes(text: str) -> bytes:
    return base64.urlsafe_b64decode(text + "=" * (-len(text) % 4))


def test_the_example_of_the_standard() -> None:
    """RFC 8291, section 5."""
    sender = ec.derive_private_key(
        int.from_bytes(_bytes("yfWPiYE-n46HLnH0KqZOF1fJJU3MYrct3AELtAQ-oRw"), "big"),
        ec.SECP256R1(),
    )
    sent = encrypt(
        b"When I grow up, I want to be a watermelon",
        _bytes(
            "BCVxsr7N_eNgVRqvHtD0zTZsEc6-VV-JvLexhqUzORcxaOzi6-AYWXvTBHm4bjyPjs7Vd8pZGH6SRpkN"
            "toIAiw4"
        ),
        _bytes("BTBZMqHH6r4Tts7J_aSIgg"),
        sender=sender,
        salt=_bytes("DGv6ra1nlYgDCS1FRnbzlw"),
    )
    assert sent == _bytes(
        "DGv6ra1nlYgDCS1FRnbzlwAAEABBBP4z9KsN6nGRTbVYI_c7VJSPQTBtkgcy27mlmlMoZIIgDll6e3vCYLocIn"
        "mYWAmS6TlzAC8wEqKK6PBru3jl7A_yl95bQpu6cVPTpK4Mqgkf1CXztLVBSt2Ks3oZwbuwXPXLWyouBWLVWGNW"
        "QexSgSxsj_Qulcy4a-fN"
    )


@given(st.binary(max_size=LARGEST_PLAIN))
def test_the_browser_reads_what_was_sent(plain: bytes) -> None:
    browser = PushBrowser()
    assert browser.read(encrypt(plain, browser.public_key, browser.auth_secret)) == plain


def test_nobody_else_reads_it() -> None:
    one, other = PushBrowser(), PushBrowser()
    sent = encrypt(b"The robot needs you", one.public_key, one.auth_secret)
    with pytest.raises(InvalidTag):
        other.read(sent)
    assert sent != encrypt(b"The robot needs you", one.public_key, one.auth_secret)


def test_too_long_and_broken_keys_are_refused() -> None:
    browser = PushBrowser()
    with pytest.raises(ValueError, match="too long"):
        encrypt(bytes(LARGEST_PLAIN + 1), browser.public_key, browser.auth_secret)
    assert not is_public_key(b"\x04" + bytes(64))
    assert not is_public_key(browser.public_key[:-1])
    assert is_public_key(browser.public_key)


def test_the_signature_is_for_one_push_service_and_ends() -> None:
    vapid = Vapid(new_key(), "mailto:owner@plugpilot.example")
    now = datetime(2026, 3, 1, 18, tzinfo=UTC)
    header = vapid.headers("https://push.example.net:8443/send/abc?x=1", now)["Authorization"]
    assert Vapid02.verify(header)
    token = header.removeprefix("vapid t=").split(",")[0]
    claims = _bytes(token.split(".")[1]).decode()
    assert '"aud":"https://push.example.net:8443"' in claims.replace(" ", "")
    assert str(int(now.timestamp()) + 12 * 3600) in claims
    assert header.endswith(f",k={vapid.public_key}")
