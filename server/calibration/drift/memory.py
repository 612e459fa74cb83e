"""What self-calibration keeps between two starts."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict, Field

from server.calibration.drift.belts import BeltMemory
from server.calibration.force.insertions import Insertions
from twin.as_built import PlanarAsBuilt

NOTE = "drift"


class DriftMemory(BaseModel):
    """All of it.

    Attributes:
        measured: The robot as it was measured last; None: as drawn.
        measured_error_mm: What that missed on looks that were held back.
        in_force_id: The version that counted when this was written, ours or not; None: as drawn.
        belts: What the looks say.
        jobs_at_version: Jobs that had been learnt from when our newest version was made.
        insertions: What the pushes say, by vehicle.
        force_scale: With which their forces were measured.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    measured: PlanarAsBuilt | None = None
    measured_error_mm: float | None = None
    in_force_id: str | None = None
    belts: BeltMemory = BeltMemory()
    jobs_at_version: int = Field(0, ge=0)
    insertions: dict[str, Insertions] = Field(default_factory=dict)
    force_scale: float = Field(1.0, gt=0)
