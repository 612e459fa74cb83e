"""Notifications on phones."""

from __future__ import annotations

from ipaddress import IPv4Network, IPv6Network

from pydantic import Field

from server.config.section import Section


class PushSettings(Section):
    """Messages go through the push service of each browser, encrypted."""

    contact: str = Field(
        "mailto:owner@plugpilot.example",
        pattern=r"^(mailto:[^@\s]+@[\w.-]+\.\w+|https://[\w.-]+)$",
        description="Whom a push service can ask about messages of this robot",
    )
    allowed_networks: tuple[IPv4Network | IPv6Network, ...] = Field(
        (),
        max_length=50,
        description="Private networks in which a push service of one's own may be",
    )
    timeout_s: float = Field(10.0, gt=0, le=60, description="Longest time of one attempt")
    retry_after_s: tuple[float, ...] = Field(
        (0.0, 10.0, 120.0, 900.0),
        min_length=1,
        max_length=8,
        description="Pauses before each attempt; after the last one the message is given up",
    )
