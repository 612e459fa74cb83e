"""Conventions of every wire model: unknown fields are refused, units stand in the names."""

from __future__ import annotations

from typing import Annotated

from pydantic import AwareDatetime, BaseModel, ConfigDict, Field

VehicleId = Annotated[
    str,
    Field(
        min_length=1,
        max_length=64,
        pattern=r"^[A-Za-z0-9][A-Za-z0-9._-]*$",
        description="Chosen by the owner; stands in the QR label",
        examples=["zoe"],
    ),
]

_UNSEEN = "\\u0000-\\u001f\\u007f-\\u009f\\u200b\\u200e\\u200f\\u2028-\\u202e\\u2060-\\u206f\\ufeff"
"""Control characters, and those that turn or hide text: with them a name could pass for another
one, or do something in a terminal. As all dialects of regular expressions spell them."""

READABLE = f"^[^{_UNSEEN}]*[^{_UNSEEN}\\s][^{_UNSEEN}]*$"
"""Pattern of a name that people read: something can be seen, and nothing is hidden."""

Timestamp = Annotated[AwareDatetime, Field(examples=["2026-03-01T18:04:05.120Z"])]


class Wire(BaseModel):
    """A model that crosses the network."""

    model_config = ConfigDict(frozen=True, extra="forbid", ser_json_inf_nan="null")
