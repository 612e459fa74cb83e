"""Between millimetres and the board's integers.

A position is an integer in 2^-31 units, a unit being a microstep or an encoder count; rates are in
2^-31 units per tick, accelerations in 2^-31 units per tick and tick. The board reports whole units,
rounded down.
"""

from __future__ import annotations

from dataclasses import dataclass

from drivers.arduino.protocol.messages import PHASE_BITS, RATE_BITS_DROPPED, TICK_HZ

ONE_UNIT = 1 << PHASE_BITS


@dataclass(frozen=True, slots=True)
class AxisScale:
    """The scale of one axis.

    Attributes:
        units_per_mm: Microsteps or encoder counts per millimetre.
    """

    units_per_mm: float

    def position(self, mm: float) -> int:
        """Fixed-point position of a length [mm]."""
        return round(mm * self.units_per_mm * ONE_UNIT)

    def mm(self, position: int) -> float:
        """Length [mm] of a fixed-point position."""
        return position / ONE_UNIT / self.units_per_mm

    def mm_of_units(self, units: int) -> float:
        """Length [mm] of whole units that were rounded down."""
        return (units + 0.5) / self.units_per_mm

    def units(self, mm: float) -> int:
        """Whole units nearest to a length [mm]."""
        return round(mm * self.units_per_mm)

    def rate(self, mm_s: float) -> int:
        """Rate of a velocity [mm/s]."""
        return round(mm_s * self.units_per_mm * ONE_UNIT / TICK_HZ)

    def mm_s(self, rate: int) -> float:
        """Velocity [mm/s] of a rate."""
        return rate / ONE_UNIT / self.units_per_mm * TICK_HZ

    def mm_s_of_telemetry(self, rate: int) -> float:
        """Velocity [mm/s] of a rate as the telemetry has it, without its lowest bits."""
        return self.mm_s(rate << RATE_BITS_DROPPED)

    def acceleration(self, mm_s2: float) -> int:
        """Acceleration in the board's integers of one in mm/s^2."""
        return round(mm_s2 * self.units_per_mm * ONE_UNIT / TICK_HZ**2)
