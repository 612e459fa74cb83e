"""Which names and which pages count as this server."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from server.api.gate.origin import is_from_elsewhere, is_own_host, is_own_origin


@pytest.mark.parametrize(
    "host",
    [
        "127.0.0.1:8000",
        "192.168.1.20",
        "[fe80::1]:8000",
        "localhost:8000",
        "robot",
        "plugpilot.local",
        "robot.home.arpa:8443",
        "robot.example.org",
        "ROBOT.example.org",
    ],
)
def test_own_names(host: str) -> None:
    assert is_own_host(host, {"robot.example.org"})


@pytest.mark.parametrize(
    "host",
    [
        "",
        "evil.example",
        "rebind.evil.example:8000",
        "localhost.evil.example",
        "plugpilot.local.evil.example",
        "127.0.0.1.nip.example",
        "user@localhost",
        "localhost/evil",
        "[::1",
        "rob\tot.evil.local",  # what takes addresses apart passes over tabs and line ends
        "local",  # has no dot, so it is fine
    ],
)
def test_a_name_that_a_stranger_can_make_lead_here(host: str) -> None:
    assert is_own_host(host, {"robot.example.org"}) is (host == "local")


@given(st.text(max_size=60))
def test_any_host_gets_a_verdict(host: str) -> None:
    assert is_own_host(host, ()) in {True, False}


@given(st.text(max_size=60), st.text(max_size=60))
def test_any_origin_gets_a_verdict(origin: str, host: str) -> None:
    assert is_own_origin(origin, "http", host) in {True, False}


@pytest.mark.parametrize(
    ("origin", "scheme", "host", "own"),
    [
        ("http://rob\rot.local", "http", "robot.local", False),
        ("http://robot:8000", "http", "robot:8000", True),
        ("http://robot", "http", "robot:80", True),
        ("https://robot", "https", "robot", True),
        ("https://robot.example", "http", "robot.example", True),  # behind a silent proxy
        ("http://robot", "https", "robot", False),
        ("http://robot:8001", "http", "robot:8000", False),
        ("http://robot.evil.example", "http", "robot", False),
        ("http://robot:8000.evil.example", "http", "robot:8000", False),
        ("null", "http", "robot", False),
        ("", "http", "robot", False),
        ("file://", "http", "robot", False),
        ("http://robot:99999", "http", "robot", False),
    ],
)
def test_own_origin(origin: str, scheme: str, host: str, own: bool) -> None:
    assert is_own_origin(origin, scheme, host) is own


LINK = {"sec-fetch-mode": "navigate", "sec-fetch-dest": "document"}


@pytest.mark.parametrize(
    ("headers", "opens_page", "foreign"),
    [
        ({}, False, False),  # a program
        ({"sec-fetch-site": "same-origin"}, False, False),
        ({"sec-fetch-site": "none"}, False, False),
        ({"sec-fetch-site": "same-site"}, False, True),  # another port of this machine
        ({"sec-fetch-site": "cross-site"}, False, True),
        ({"sec-fetch-site": "cross-site"} | LINK, True, False),
        ({"sec-fetch-site": "cross-site"} | LINK, False, True),
        ({"sec-fetch-site": "cross-site"} | LINK | {"sec-fetch-dest": "iframe"}, True, True),
        ({"origin": "http://robot"}, False, False),
        ({"origin": "http://evil.example"}, False, True),
        ({"origin": "null"}, False, True),
        ({"origin": "http://evil.example", "sec-fetch-site": "same-origin"}, False, True),
    ],
)
def test_who_made_the_browser_ask(
    headers: dict[str, str],
    opens_page: bool,
    foreign: bool,
) -> None:
    asked = {"host": "robot"} | headers
    assert is_from_elsewhere(asked, "http", opens_page=opens_page) is foreign
