"""A divergence in words: what is off, where, by how much, and what may be behind it."""

from __future__ import annotations

from twin.divergence.findings import Divergence, Quantity

_TITLES = {
    Quantity.RHO1: "The left carriage does not follow",
    Quantity.RHO2: "The right carriage does not follow",
    Quantity.RHO3: "The slide does not follow",
    Quantity.SET_POINT: "The motion board keeps another time",
    Quantity.FORCE: "The force is not that of a good insertion",
    Quantity.SOCKET: "The socket seems to have moved",
    Quantity.PHASE_TIME: "This step takes too long",
}

_SUBJECTS = {
    Quantity.RHO1: "The left carriage",
    Quantity.RHO2: "The right carriage",
    Quantity.RHO3: "The slide",
}


def title(quantity: Quantity) -> str:
    """What is off, the same for every occurrence."""
    return _TITLES[quantity]


def sentence(divergence: Divergence) -> str:
    """This occurrence with its figures."""
    residual, place = divergence.residual, divergence.place
    off, sigmas = abs(residual.difference), f"{residual.sigmas:.0f} times its uncertainty"
    match residual.quantity:
        case Quantity.RHO1 | Quantity.RHO2 | Quantity.RHO3:
            subject = _SUBJECTS[residual.quantity]
            return (
                f"{subject} is at {residual.measured:.2f} mm instead of {residual.expected:.2f} mm"
                f": {off:.2f} mm off, {sigmas}."
            )
        case Quantity.SET_POINT:
            return (
                f"The board is at {residual.measured:.1f} mm of its plan where "
                f"{residual.expected:.1f} mm was due: {off:.1f} mm off, {sigmas}."
            )
        case Quantity.FORCE:
            return (
                f"{_where(divergence)} takes {abs(residual.measured):.0f} N where "
                f"{abs(residual.expected):.0f} N is usual: {off:.0f} N off, {sigmas}."
            )
        case Quantity.SOCKET:
            return (
                f"It is {off:.2f} mm from where it was first seen, {sigmas}: the car was moved, "
                "or a carriage has lost steps."
            )
        case Quantity.PHASE_TIME:
            return (
                f"The step {place.phase} has taken {residual.measured:.1f} s; "
                f"{residual.expected:.1f} s is usual."
            )


def _where(divergence: Divergence) -> str:
    depth_mm, rho3_mm = divergence.place.depth_mm, divergence.place.joints.rho3_mm
    inwards = divergence.residual.expected > 0
    if depth_mm is None or depth_mm < 0:
        return f"Moving the plug freely, with the slide at {rho3_mm:.0f} mm,"
    verb = "Pushing" if inwards else "Pulling"
    return f"{verb} the plug {depth_mm:.1f} mm deep"
