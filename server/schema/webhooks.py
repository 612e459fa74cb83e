"""Webhooks as the API shows them."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import AfterValidator, Field

from server.schema.base import Timestamp, Wire
from server.schema.events import EventType
from server.webhooks.address import checked_url

TargetUrl = Annotated[
    str,
    Field(
        max_length=2000,
        description="HTTPS for public addresses. A target in the home network, by HTTP too, must "
        "be in webhooks.allowed_networks of the configuration. Redirects are not followed",
        examples=["https://example.com/plugpilot"],
    ),
    AfterValidator(checked_url),
]
DeliveryState = Literal["waiting", "delivered", "failed", "dropped"]


def _without_repetition(events: list[EventType]) -> list[EventType]:
    return list(dict.fromkeys(events))


class WebhookSettings(Wire):
    """What somebody says about a webhook."""

    url: TargetUrl
    events: Annotated[
        list[EventType],
        Field(min_length=1, max_length=50, description="Which events to send"),
        AfterValidator(_without_repetition),
    ]
    description: Annotated[str, Field(max_length=200)] = ""
    enabled: bool = Field(default=True, description="False keeps it, but sends nothing")


class Webhook(WebhookSettings):
    """Somebody who is told what happens."""

    id: str = Field(examples=["01957a3c-7d50-7c44-8e0f-5b3c9d5a1f00"])
    disabled_reason: str | None = Field(
        description="Why PlugPilot switched it off, such as an answer 410 Gone"
    )
    created_at: Timestamp


class WebhookWithSecret(Webhook):
    """A webhook with its secret, which is shown this once."""

    secret: str = Field(
        description="Verifies the signature (Standard Webhooks 1.0)",
        examples=["whsec_MfKQ9r8GKYqrTwjUPD8ILPZIo2LaLaSw"],
    )


class WebhookPage(Wire):
    """Webhooks, oldest first."""

    items: list[Webhook]
    next_cursor: str | None = Field(description="Pass as ?cursor= for the next page; null: end")


class Attempt(Wire):
    """One attempt to deliver."""

    at: Timestamp
    status: int | None = Field(description="HTTP status of the answer; null without one")
    error: str | None = Field(description="What went wrong, in words; null if nothing did")
    duration_s: float = Field(ge=0)


class Delivery(Wire):
    """One event for one webhook."""

    id: str
    event_id: str = Field(description="Sent as webhook-id, the same in every attempt")
    event_type: str = Field(examples=["job.ended"])
    state: DeliveryState = Field(
        description="dropped: it gave way to newer ones, or the webhook was switched off"
    )
    created_at: Timestamp
    next_attempt_at: Timestamp | None = Field(description="Null once it has ended")
    attempts: list[Attempt]


class DeliveryPage(Wire):
    """Deliveries, newest first."""

    items: list[Delivery]
    next_cursor: str | None = Field(description="Pass as ?cursor= for the next page; null: end")
