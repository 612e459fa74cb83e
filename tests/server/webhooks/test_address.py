"""Where webhooks may go, and above all where not."""

from __future__ import annotations

from collections.abc import Sequence
from ipaddress import ip_address, ip_network

import pytest

from server.webhooks.address import (
    IpAddress,
    TargetRefusedError,
    TargetUnknownError,
    admit,
    checked_url,
    resolve,
)

HOME = (ip_network("192.168.1.0/24"),)


def leads_to(*addresses: str) -> object:
    async def resolve_name(host: str, port: int) -> Sequence[IpAddress]:
        del host, port
        return [ip_address(address) for address in addresses]

    return resolve_name


@pytest.mark.parametrize(
    "address",
    [
        "127.0.0.1",
        "127.8.8.8",
        "10.0.0.8",
        "172.16.3.4",
        "192.168.1.7",
        "169.254.169.254",
        "100.64.0.1",
        "0.0.0.0",  # noqa: S104 - a target here, nothing to bind to
        "224.0.0.1",
        "255.255.255.255",
        "::1",
        "::",
        "fe80::1",
        "fd00::1",
        "ff02::1",
        "::ffff:127.0.0.1",
        "::ffff:192.168.1.7",
        "64:ff9b::7f00:1",
        "2002:7f00:1::",
    ],
)
async def test_nothing_inside_is_reached(address: str) -> None:
    with pytest.raises(TargetRefusedError, match="allowed_networks"):
        await admit("https://innocent.example/hook", (), leads_to(address))  # type: ignore[arg-type]


async def test_one_address_inside_among_public_ones_is_enough_to_refuse() -> None:
    resolve_name = leads_to("93.184.216.34", "127.0.0.1")
    with pytest.raises(TargetRefusedError):
        await admit("https://innocent.example", (), resolve_name)  # type: ignore[arg-type]


async def test_the_address_that_was_checked_is_the_one_that_is_used() -> None:
    target = await admit(
        "https://innocent.example/a/b?c=d",
        (),
        leads_to("93.184.216.34"),  # type: ignore[arg-type]
    )
    assert target.url == "https://93.184.216.34:443/a/b?c=d"
    assert (target.host, target.netloc) == ("innocent.example", "innocent.example")
    target = await admit(
        "https://innocent.example:8443",
        (),
        leads_to("2606:2800:220:1::1"),  # type: ignore[arg-type]
    )
    assert target.url == "https://[2606:2800:220:1::1]:8443"
    assert target.netloc == "innocent.example:8443"


async def test_the_home_network_only_where_it_is_allowed() -> None:
    target = await admit("http://192.168.1.7:8123/api/webhook/x", HOME)
    assert target.url == "http://192.168.1.7:8123/api/webhook/x"
    for url in ("http://192.168.2.7", "http://127.0.0.1", "http://[::ffff:10.0.0.1]"):
        with pytest.raises(TargetRefusedError):
            await admit(url, HOME)
    mapped = leads_to("::ffff:192.168.1.7")
    assert await admit("http://nas.home", HOME, mapped)  # type: ignore[arg-type]


async def test_other_spellings_of_inside_are_inside() -> None:
    for url in ("https://2130706433/", "https://0x7f.1/", "https://127.1/", "https://localhost/"):
        with pytest.raises(TargetRefusedError):
            await admit(url, ())


async def test_public_targets_need_https() -> None:
    with pytest.raises(TargetRefusedError, match="https"):
        await admit("http://93.184.216.34/", ())


async def test_a_name_that_leads_nowhere_is_told() -> None:
    with pytest.raises(TargetUnknownError, match=r"nowhere\.invalid"):
        await resolve("nowhere.invalid", 443)


@pytest.mark.parametrize(
    "url",
    [
        "ftp://example.com",
        "file:///etc/passwd",
        "https://",
        "https://user:secret@example.com",
        "https://example.com:0/",
        "https://example.com:99999/",
        "https://exa mple.com",
        "https://example.com/\r\nX: y",
        "https://exämple.com/",
        "gopher://127.0.0.1:25/",
        "nonsense",
    ],
)
def test_what_is_no_web_address_is_refused(url: str) -> None:
    with pytest.raises(ValueError, match="must"):
        checked_url(url)
