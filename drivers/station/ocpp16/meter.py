"""Reading the meter values of OCPP 1.6."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

VOLTAGE_V = 230.0
UNITS = {"Wh": 1.0, "kWh": 1000.0, "W": 1.0, "kW": 1000.0, "A": 1.0}
ENERGY = "Energy.Active.Import.Register"
POWER = "Power.Active.Import"
CURRENT = "Current.Import"
PHASES = ("L1", "L2", "L3")


@dataclass(frozen=True, slots=True)
class MeterReading:
    """What the meter says; None where it says nothing.

    Attributes:
        power_w: Active power [W].
        currents_a: Phase currents [A].
        energy_wh: Register of the meter [Wh].
    """

    power_w: float | None
    currents_a: tuple[float, float, float] | None
    energy_wh: float | None

    @property
    def shows_load(self) -> bool:
        """It says whether a current flows."""
        return self.power_w is not None or self.currents_a is not None

    @property
    def all_currents_a(self) -> tuple[float, float, float]:
        """Currents; without their own values all the power may be in one phase [A]."""
        return self.currents_a or ((self.power_w or 0.0) / VOLTAGE_V, 0.0, 0.0)


def read_meter(samples: Iterable[Mapping[str, str]]) -> MeterReading:
    """Make a reading of `sampledValue`.

    Raises:
        ValueError: a value is no number or has a unit that does not belong there.
    """
    found: dict[str, dict[str, float]] = {}
    for sample in samples:
        measurand = sample.get("measurand", ENERGY)
        if measurand not in {ENERGY, POWER, CURRENT} or sample.get("format", "Raw") != "Raw":
            continue
        # "L1-N" is the phase L1 as well
        phase = sample.get("phase", "").removesuffix("-N")
        found.setdefault(measurand, {})[phase] = _value(sample, measurand)
    return MeterReading(
        power_w=_sum(found.get(POWER)),
        currents_a=_currents(found.get(CURRENT)),
        energy_wh=_sum(found.get(ENERGY)),
    )


def _value(sample: Mapping[str, str], measurand: str) -> float:
    default = {ENERGY: "Wh", POWER: "W", CURRENT: "A"}[measurand]
    unit = sample.get("unit", default)
    if unit not in UNITS or not unit.endswith(default):
        msg = f"{measurand} in {unit}"
        raise ValueError(msg)
    value = float(sample["value"]) * UNITS[unit]
    if not math.isfinite(value):
        msg = f"{measurand} is {sample['value']}"
        raise ValueError(msg)
    return abs(value)


def _sum(by_phase: Mapping[str, float] | None) -> float | None:
    if not by_phase:
        return None
    if "" in by_phase:
        return by_phase[""]
    parts = [by_phase[phase] for phase in PHASES if phase in by_phase]
    return sum(parts) if parts else None


def _currents(by_phase: Mapping[str, float] | None) -> tuple[float, float, float] | None:
    if not by_phase:
        return None
    if any(phase in by_phase for phase in PHASES):
        first, second, third = (by_phase.get(phase, 0.0) for phase in PHASES)
        return first, second, third
    # One value for all: the same current may flow in each of them.
    return (by_phase[""],) * 3 if "" in by_phase else None
