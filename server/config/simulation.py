"""How the simulator plays."""

from __future__ import annotations

from pydantic import Field

from drivers.simulator.parameters import SimulationParameters
from server.config.section import Section


class SimulationSettings(Section):
    """Chance, time and physics of the simulated world; a real robot keeps real time."""

    seed: int = Field(0, ge=0, le=2**63 - 1, description="Same seed, same noise, same car")
    speed: float = Field(1.0, gt=0, le=100, description="Simulated seconds per second")
    parameters: SimulationParameters = SimulationParameters()
