"""Who may be told what happens, and how patiently."""

from __future__ import annotations

from ipaddress import IPv4Network, IPv6Network

from pydantic import Field

from server.config.section import Section

RETRY_AFTER_S = (0.0, 5.0, 300.0, 1800.0, 7200.0, 18000.0)
"""Pauses before each attempt, as Standard Webhooks 1.0 proposes."""


class WebhookSettings(Section):
    """Webhooks go to public addresses by HTTPS; to the home network only where it is allowed."""

    allowed_networks: tuple[IPv4Network | IPv6Network, ...] = Field(
        (),
        max_length=50,
        description="Private networks that webhooks may reach, by HTTP too, such as 192.168.1.0/24",
    )
    timeout_s: float = Field(10.0, gt=0, le=60, description="Longest time of one attempt")
    max_webhooks: int = Field(20, ge=1, le=100, description="So many may be made")
    max_waiting: int = Field(
        500, ge=1, le=10_000, description="Deliveries that wait for one target; the oldest give way"
    )
    max_log: int = Field(
        200, ge=1, le=10_000, description="Ended deliveries that are kept of each webhook"
    )
    retry_after_s: tuple[float, ...] = Field(
        RETRY_AFTER_S,
        min_length=1,
        max_length=12,
        description="Pauses before each attempt; after the last one the delivery has failed",
    )
