"""Notifications of a browser (Web Push)."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, StringConstraints

from server.schema.base import Wire

PushLanguage = Literal["en", "fr", "de", "it"]


class PushState(Wire):
    """Whether this browser is notified."""

    public_key: str = Field(
        description="The robot's key: what a browser takes as applicationServerKey",
        examples=[
            "BA1Hxzyi1RUM1b5wjxsn7nGxAszw2u61m164i3MrAIxHF6YK5h4SDYic-dRuU_RCPCfA5aq9ojSwk5Y2EmClBPs"
        ],
    )
    subscribed: bool = Field(description="This device is told what happens")


class PushSubscription(Wire):
    """What a browser's pushManager gives."""

    endpoint: Annotated[str, StringConstraints(max_length=2000)] = Field(
        description="Where messages for this browser go, by https",
        examples=["https://push.example.net/send/bGF0ZXI"],
    )
    p256dh: Annotated[str, StringConstraints(max_length=100, pattern=r"^[\w-]+=*$")] = Field(
        description="The browser's public key, base64url"
    )
    auth: Annotated[str, StringConstraints(max_length=40, pattern=r"^[\w-]+=*$")] = Field(
        description="The browser's secret, base64url"
    )
    language: PushLanguage = Field("en", description="Speak so")
