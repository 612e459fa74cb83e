"""What good insertions into one socket feel like, and when they begin to feel otherwise.

The first good insertions make the band, and it stays: a band that crept along with the plug would
never notice that it wears. Only many later ones together are compared with it, so that one cold
morning is no hint.
"""

from __future__ import annotations

from statistics import fmean, median

from pydantic import BaseModel, ConfigDict

from server.schema.calibrations import ForceValues
from server.schema.drift import InsertionBand, MaintenanceHint
from server.schema.vehicles import Vehicle
from twin.force_band import ForceBand, learn_band

Curve = tuple[tuple[float, float], ...]

BAND_FROM, COMPARED = 8, 5
"""Good insertions that make the band, and later ones that are compared with it."""
SIGMAS, MARGIN_N = 4.0, 4.0
DEPTHS_MM = tuple(range(0, 41, 4))
FEWEST_POINTS = 2
"""So many depths must be outside of the band."""
FREE_FROM_MM, FREE_TO_MM = -14.0, -4.0
"""On this bit of the way the plug touches nothing."""
HEAVIER_N = 3.0
OFF_MM = 0.5
"""A plug that goes in only so far beside the label's word, again and again: the label has moved."""


class Insertions(BaseModel):
    """Of one vehicle.

    Attributes:
        first: (Depth [mm], force [N]) of the first good insertions.
        recent: The same of the last ones after these.
        offsets_mm: How far beside the measured place the last plugs went in, right and up.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    first: tuple[Curve, ...] = ()
    recent: tuple[Curve, ...] = ()
    offsets_mm: tuple[tuple[float, float], ...] = ()

    def taken(self, curve: Curve, offset_mm: tuple[float, float]) -> Insertions:
        """After one more good insertion."""
        offsets = (*self.offsets_mm, offset_mm)[-COMPARED:]
        if len(self.first) < BAND_FROM:
            return Insertions(first=(*self.first, curve), offsets_mm=offsets)
        recent = (*self.recent, curve)[-COMPARED:]
        return Insertions(first=self.first, recent=recent, offsets_mm=offsets)

    @property
    def band(self) -> ForceBand | None:
        """None until there are enough."""
        if len(self.first) < BAND_FROM:
            return None
        try:
            return learn_band(self.first, DEPTHS_MM, sigmas=SIGMAS, margin_n=MARGIN_N)
        except ValueError:  # no depth was reached by all of them
            return None

    def mean_recent_n(self, depth_mm: float) -> float | None:
        """Mean force of the last insertions about a depth; None: not enough of them."""
        if len(self.recent) < COMPARED:
            return None
        near = [f for curve in self.recent for d, f in curve if abs(d - depth_mm) <= 2.0]
        return fmean(near) if near else None

    def shown(self, vehicle_id: str) -> InsertionBand:
        """As the API shows it."""
        band = self.band
        means = [(float(depth), self.mean_recent_n(depth)) for depth in DEPTHS_MM]
        return InsertionBand(
            vehicle_id=vehicle_id,
            learnt_from=len(self.first),
            points=list(band.points) if band else [],
            recent=[(depth, force) for depth, force in means if force is not None],
        )


def hints_of(
    vehicle: Vehicle, felt: Insertions, force: ForceValues | None
) -> list[MaintenanceHint]:
    """What wears, or has moved.

    Args:
        vehicle: Whose socket.
        felt: Its insertions.
        force: The slide as it was measured; None: it never was.
    """
    found = (_by_force(vehicle, felt), _by_friction(felt, force), _by_offset(vehicle, felt))
    return [hint for hint in found if hint is not None]


def _by_force(vehicle: Vehicle, felt: Insertions) -> MaintenanceHint | None:
    band = felt.band
    if band is None:
        return None
    heavy, light = [], []
    for depth_mm in DEPTHS_MM:
        mean_n = felt.mean_recent_n(depth_mm)
        if mean_n is None:
            continue
        lower_n, upper_n = band.at(depth_mm)
        if mean_n > upper_n:
            heavy.append((mean_n - upper_n, depth_mm, mean_n, lower_n, upper_n))
        elif mean_n < lower_n:
            light.append((lower_n - mean_n, depth_mm, mean_n, lower_n, upper_n))
    if len(heavy) >= FEWEST_POINTS:
        return MaintenanceHint(
            code="plug_heavy",
            title="The plug goes in harder than it used to",
            text=f"{_compared(max(heavy))} Clean plug and socket, and look for bent contacts.",
            vehicle_id=vehicle.id,
        )
    if len(light) >= FEWEST_POINTS:
        return MaintenanceHint(
            code="plug_light",
            title="The plug goes in more easily than it used to",
            text=f"{_compared(max(light))} Its contacts may be worn: have plug and socket checked.",
            vehicle_id=vehicle.id,
        )
    return None


def _compared(worst: tuple[float, int, float, float, float]) -> str:
    _, depth_mm, mean_n, lower_n, upper_n = worst
    return (
        f"At a depth of {depth_mm} mm the last {COMPARED} insertions took {mean_n:.0f} N; "
        f"{lower_n:.0f} to {upper_n:.0f} N were usual."
    )


def _by_friction(felt: Insertions, force: ForceValues | None) -> MaintenanceHint | None:
    now_n = _free_n(felt.recent)
    usual_n = _free_n(felt.first)
    if force is not None:
        usual_n = (force.friction_n + force.offset_n) / force.shown_per_true
    enough = len(felt.recent) >= COMPARED and (force or len(felt.first) >= BAND_FROM)
    if now_n is None or usual_n is None or not enough or now_n <= 2 * usual_n + HEAVIER_N:
        return None
    return MaintenanceHint(
        code="slide_heavy",
        title="The slide runs harder than it used to",
        text=f"Before the socket it takes {now_n:.1f} N; {usual_n:.1f} N were usual. Clean and "
        "grease its screw.",
        vehicle_id=None,
    )


def _free_n(curves: tuple[Curve, ...]) -> float | None:
    free = [f for curve in curves for d, f in curve if FREE_FROM_MM <= d <= FREE_TO_MM]
    return fmean(free) if free else None


def _by_offset(vehicle: Vehicle, felt: Insertions) -> MaintenanceHint | None:
    if len(felt.offsets_mm) < COMPARED:
        return None
    right_mm = median(right for right, _ in felt.offsets_mm)
    up_mm = median(up for _, up in felt.offsets_mm)
    if max(abs(right_mm), abs(up_mm)) < OFF_MM:
        return None
    return MaintenanceHint(
        code="socket_off",
        title="The socket is not where its label says",
        text=f"The last plugs went in {right_mm:+.1f} mm to the right and {up_mm:+.1f} mm up from "
        f"there. Look whether the label of {vehicle.name} has come loose, then teach the socket "
        "again.",
        vehicle_id=vehicle.id,
    )
