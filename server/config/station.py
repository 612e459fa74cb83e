"""Which charging station gives the power."""

from __future__ import annotations

from typing import Literal, Self

from pydantic import Field, model_validator

from drivers.station.settings import StationGroups


class StationSettings(StationGroups):
    """The charging station that the robot's plug hangs on."""

    driver: Literal["simulator", "openevse", "evcc", "goe", "shelly", "http", "ocpp"] = Field(
        "simulator", description="Kind of station; a simulated one goes with a real robot, too"
    )
    manager: Literal["none", "evcc"] = Field(
        "none", description="Energy manager that controls the station"
    )

    @model_validator(mode="after")
    def _groups_in_use_are_there(self) -> Self:
        for use, name in (("driver", self.driver), ("manager", self.manager)):
            if name not in {"simulator", "none"} and getattr(self, name) is None:
                msg = f"{use} = {name!r} needs the settings in [station.{name}]"
                raise ValueError(msg)
        if self.manager != "none" and self.driver in {"simulator", self.manager}:
            msg = (
                f"manager = {self.manager!r} needs the station behind it as driver, "
                f"not {self.driver!r}"
            )
            raise ValueError(msg)
        return self
