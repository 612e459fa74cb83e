"""Where the robot waits."""

from __future__ import annotations

from pydantic import Field

from server.config.section import Section


class ParkSettings(Section):
    """The park position: the plug out of the way, the camera on the place of the car."""

    x_mm: float = Field(616.0, ge=-10_000, le=10_000, description="Of V, along the rail")
    y_mm: float = Field(335.0, ge=-10_000, le=10_000, description="Of V, from the rail")
    rho3_mm: float = Field(50.0, ge=-10_000, le=10_000, description="Of the insertion slide")
