"""What a kilowatt-hour costs, and when."""

from __future__ import annotations

from datetime import time
from itertools import pairwise
from typing import Self
from zoneinfo import ZoneInfo, ZoneInfoNotFoundError

from pydantic import Field, field_validator, model_validator

from server.config.section import Section


class PriceWindow(Section):
    """A price of its own for some hours of every day; they may go over midnight."""

    begin: time = Field(description='Local time, such as "22:00"')
    end: time = Field(description="Local time; what begins at that minute is no longer meant")
    price_per_kwh: float = Field(ge=-100, le=100, description="Negative where energy is given away")

    @model_validator(mode="after")
    def _is_a_plain_span(self) -> Self:
        if self.begin == self.end:
            raise ValueError("begin and end are the same time: for the whole day use price_per_kwh")
        if self.begin.tzinfo is not None or self.end.tzinfo is not None:
            raise ValueError("write local times without a zone; the zone is tariff.time_zone")
        return self

    @property
    def spans(self) -> tuple[tuple[time, time | None], ...]:
        """The parts of one day that are meant: from, and until; None is midnight."""
        if self.begin < self.end:
            return ((self.begin, self.end),)
        before_noon = () if self.end == time.min else ((time.min, self.end),)
        return (*before_noon, (self.begin, None))


class TariffSettings(Section):
    """Without a currency no cost is shown."""

    currency: str | None = Field(
        None, pattern=r"^[A-Z]{3}$", description='ISO 4217, such as "EUR" or "CHF"'
    )
    price_per_kwh: float = Field(
        0.0, ge=-100, le=100, description="Outside of all windows, in the currency"
    )
    windows: tuple[PriceWindow, ...] = Field(
        (), max_length=24, description="Hours with a price of their own, such as the night"
    )
    time_zone: str | None = Field(
        None,
        max_length=64,
        description='Of the windows, such as "Europe/Rome"; else the machine\'s',
    )

    @field_validator("time_zone")
    @classmethod
    def _is_known(cls, name: str | None) -> str | None:
        if name is not None:
            try:
                ZoneInfo(name)
            except (ZoneInfoNotFoundError, ValueError) as error:
                msg = f"there is no time zone {name!r}; write one like Europe/Rome"
                raise ValueError(msg) from error
        return name

    @model_validator(mode="after")
    def _windows_do_not_overlap(self) -> Self:
        spans = sorted(
            (begin, end or time.max) for window in self.windows for begin, end in window.spans
        )
        for (_, end), (begin, _) in pairwise(spans):
            if begin < end:
                msg = f"two windows contain {begin:%H:%M}: let one end where the other begins"
                raise ValueError(msg)
        return self
