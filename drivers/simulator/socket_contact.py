"""Forces between plug and socket along the insertion axis.

The contacts of the socket rub: up to a limit that depends on the depth they hold the plug like a
spring, beyond it they slip. So a plug that has been pushed in and is then pulled first relaxes,
then resists the other way. The end stop and the connector lock are springs; a plug that misses
the opening meets the panel, another spring.
"""

from __future__ import annotations

import math
from enum import Enum
from typing import NamedTuple

from drivers.simulator.interpolation import interpolated
from drivers.simulator.parameters import ContactParameters
from twin.kinematics import PlatformPosition


class Place(Enum):
    """Where the plug is."""

    FREE = "free"
    IN_SOCKET = "in_socket"
    AGAINST_PANEL = "against_panel"


class Contact(NamedTuple):
    """State of the contact.

    Attributes:
        place: Where the plug is.
        depth_mm: Tip behind the socket's face; negative in front of it.
        slip_mm: Elastic deflection of the rubbing contacts, positive when pushed in.
        force_n: What the socket does against the plug, positive against going in.
        entry_lateral_mm: Distance of the plug's axis from the socket's when it last reached the
            face; None if it never did.
        entry_platform: V at that moment.
        locked_at_mm: Depth at which the connector lock caught; None while open.
    """

    place: Place = Place.FREE
    depth_mm: float = -math.inf
    slip_mm: float = 0.0
    force_n: float = 0.0
    entry_lateral_mm: float | None = None
    entry_platform: PlatformPosition | None = None
    locked_at_mm: float | None = None


FREE = Contact()


class SocketContact:
    """The socket of one car.

    Args:
        parameters: What all sockets have in common.
        peak_force_n: Insertion force of this one at the worst depth.
    """

    def __init__(self, parameters: ContactParameters, peak_force_n: float) -> None:
        self._parameters = parameters
        self._peak_n = peak_force_n

    def insertion_limit_n(self, depth_mm: float, lateral_mm: float) -> float:
        """Force at which the contacts slip inwards."""
        share = interpolated(self._parameters.engagement, depth_mm)
        return self._peak_n * share + self._parameters.misalignment_friction_n_mm * lateral_mm

    def withdrawal_limit_n(self, depth_mm: float, lateral_mm: float) -> float:
        """Force at which the contacts slip outwards."""
        share = interpolated(self._parameters.withdrawal, depth_mm)
        return self._peak_n * share + self._parameters.misalignment_friction_n_mm * lateral_mm

    def moved(
        self, contact: Contact, depth_mm: float, lateral_mm: float, platform: PlatformPosition
    ) -> Contact:
        """The contact after the plug has moved to a depth.

        Args:
            contact: Before.
            depth_mm: Tip behind the face.
            lateral_mm: Distance of the tip from the socket's axis, as if nothing centred it.
            platform: Where V is, to be remembered at the entry.
        """
        if depth_mm < 0:
            return contact._replace(place=Place.FREE, depth_mm=depth_mm, slip_mm=0.0, force_n=0.0)
        if contact.place is Place.FREE:
            fits = lateral_mm <= self._parameters.compliance_mm
            contact = contact._replace(
                place=Place.IN_SOCKET if fits else Place.AGAINST_PANEL,
                depth_mm=0.0,
                entry_lateral_mm=lateral_mm,
                entry_platform=platform,
            )
        if contact.place is Place.AGAINST_PANEL:
            force_n = self._parameters.jam_stiffness_n_mm * depth_mm
            return contact._replace(depth_mm=depth_mm, force_n=force_n)
        return self._rubbed(contact, depth_mm, lateral_mm)

    def _rubbed(self, contact: Contact, depth_mm: float, lateral_mm: float) -> Contact:
        stiffness = self._parameters.friction_stiffness_n_mm
        slip_mm = contact.slip_mm + depth_mm - contact.depth_mm
        slip_mm = min(slip_mm, self.insertion_limit_n(depth_mm, lateral_mm) / stiffness)
        slip_mm = max(slip_mm, -self.withdrawal_limit_n(depth_mm, lateral_mm) / stiffness)
        force_n = stiffness * slip_mm
        force_n += self._parameters.stop_stiffness_n_mm * max(
            depth_mm - self._parameters.stop_depth_mm, 0.0
        )
        if contact.locked_at_mm is not None:
            pulled_mm = max(contact.locked_at_mm - depth_mm, 0.0)
            force_n -= self._parameters.lock_stiffness_n_mm * pulled_mm
        return contact._replace(depth_mm=depth_mm, slip_mm=slip_mm, force_n=force_n)
