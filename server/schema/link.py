"""How well the link to the motion board does."""

from __future__ import annotations

from pydantic import Field

from server.schema.base import Timestamp, Wire


class RoundTripTimes(Wire):
    """From a question to the board until its answer."""

    newest_s: float = Field(ge=0)
    median_s: float = Field(ge=0, description="Of the newest answers")
    worst_s: float = Field(ge=0, description="The slowest of the newest answers")
    answers: int = Field(ge=1, description="How many those are")


class LinkReport(Wire):
    """The link to the motion board. Counters begin at zero whenever the link is opened.

    What is not known is null: nothing is measured without a link, and a simulated board has no
    frames that could be damaged.
    """

    at: Timestamp
    online: bool = Field(description="Telemetry comes")
    telemetry_hz: float | None = Field(
        ge=0, description="Samples per second lately: about 10 at rest, about 100 while it moves"
    )
    sample_age_s: float | None = Field(ge=0, description="Of the newest sample, at this moment")
    sample_delay_s: float | None = Field(
        ge=0, description="From when the board took the newest sample until it was here"
    )
    round_trip: RoundTripTimes | None
    received: int | None = Field(ge=0, description="Intact frames from the board")
    damaged: int | None = Field(ge=0, description="Frames from the board that came damaged")
    damaged_at_board: int | None = Field(
        ge=0, description="Frames to the board that came damaged there"
    )
    sent_again: int | None = Field(
        ge=0, description="Messages sent again because no acknowledgement came in time"
    )
    reconnections: int | None = Field(
        ge=0, description="How often the link was opened anew since PlugPilot was started"
    )
    supply_v: float | None = Field(description="Supply of the board; null if not measured")
    temperature_degc: float | None = Field(description="On the board; null if not measured")
