"""From what the model finds to what everyone may see."""

from __future__ import annotations

from collections.abc import Iterable

from server.schema.divergence import DivergenceReport, TwinReport
from server.schema.robot import Joints
from server.timing import Calendar
from twin.divergence import Divergence
from twin.divergence.words import sentence, title


def twin_report(parted: Iterable[Divergence], calendar: Calendar) -> TwinReport:
    """All alarms that are on."""
    return TwinReport(divergences=[divergence_report(d, calendar) for d in parted])


def divergence_report(divergence: Divergence, calendar: Calendar) -> DivergenceReport:
    """One of them, as it was when it began."""
    residual, place = divergence.residual, divergence.place
    return DivergenceReport(
        quantity=residual.quantity,
        title=title(residual.quantity),
        message=sentence(divergence),
        unit=residual.unit,
        expected=round(residual.expected, 3),
        measured=round(residual.measured, 3),
        sigma=round(residual.sigma, 4),
        sigmas=round(residual.sigmas, 1),
        at=calendar.at(place.at_s),
        phase=place.phase,
        joints=Joints(
            rho1_mm=round(place.joints.rho1_mm, 3),
            rho2_mm=round(place.joints.rho2_mm, 3),
            rho3_mm=round(place.joints.rho3_mm, 3),
        ),
        depth_mm=None if place.depth_mm is None else round(place.depth_mm, 2),
        tip_off_mm=None if place.tip_off_mm is None else round(place.tip_off_mm, 3),
    )
