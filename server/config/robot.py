"""Which robot is driven, and over which link."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from drivers.arduino.settings import BoardSettings
from server.config.section import Section


class RobotSettings(Section):
    """The motion board."""

    driver: Literal["simulator", "arduino"] = Field("simulator", description="Kind of board")
    port: str = Field(
        "auto",
        min_length=1,
        description="Serial port of the board; auto looks for it. The simulator needs none",
    )
    board: BoardSettings = Field(
        default_factory=BoardSettings, description="The real board and its drives"
    )
