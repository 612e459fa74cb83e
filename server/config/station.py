"""Which charging station gives the power."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from server.config.section import Section


class StationSettings(Section):
    """The charging station that the robot's plug hangs on."""

    driver: Literal["simulator"] = Field(
        "simulator", description="Kind of station; a simulated one goes with a real robot, too"
    )
