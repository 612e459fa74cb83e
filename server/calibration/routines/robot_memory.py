"""What the robot's routine has collected, as it outlives a restart."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Self

import numpy as np
from pydantic import BaseModel, ConfigDict, Field

from server.calibration.robot.looks import LabelLook
from server.schema.routines import RobotRoutineRequest
from twin.joints import JointPosition

Pair = tuple[float, float]
Triple = tuple[float, float, float]


class KeptLook(BaseModel):
    """A look."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    rho_mm: Pair
    label_mm: Triple
    covariance_mm2: tuple[Triple, Triple, Triple]
    turned_rad: float

    @classmethod
    def of(cls, look: LabelLook) -> Self:
        """A look to keep."""
        return cls.model_validate(
            {
                "rho_mm": look.rho_mm.tolist(),
                "label_mm": look.label_mm.tolist(),
                "covariance_mm2": look.covariance_mm2.tolist(),
                "turned_rad": look.turned_rad,
            }
        )

    @property
    def look(self) -> LabelLook:
        """As the solver takes it."""
        return LabelLook(
            np.array(self.rho_mm),
            np.array(self.label_mm),
            np.array(self.covariance_mm2),
            self.turned_rad,
        )


class RobotMemory(BaseModel):
    """Of a routine whose places are chosen.

    Attributes:
        request: What was asked for.
        vehicle_id: Whose label.
        stood_at: Joints of the first look, to which the robot comes back.
        platform_mm: Where the platform was believed to be then.
        first: That look.
        looks: All of them.
        left: Places that are still to be looked from.
        spent_s: Robot time before the newest beginning.
        begun_at: When the routine was begun, so that no other one takes this for its own.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    request: RobotRoutineRequest
    vehicle_id: str
    stood_at: JointPosition
    platform_mm: Pair
    first: KeptLook
    looks: tuple[KeptLook, ...]
    left: tuple[JointPosition, ...]
    spent_s: Annotated[float, Field(ge=0)]
    begun_at: datetime | None = None
