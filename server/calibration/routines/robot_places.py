"""Where the robot's routine looks from next: by the drawing first, then by what it has learnt.

A camera that is turned by three degrees shows the label 70 px beside where the drawing has it. So
the first few places keep well away from the picture's edge and from the plug. Looks from them tell
how the camera is turned, and all other places are chosen with that, as far apart as the picture
allows: none of them is lost.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from server.calibration.robot.errors import RobotFitDivergedError
from server.calibration.robot.known_before import KnownBefore
from server.calibration.robot.looks import LabelLook
from server.calibration.robot.poses import choose_places, in_travelling_order
from server.calibration.robot.solve import FEWEST_LOOKS, solve_robot
from server.calibration.robot.unknowns import Unknowns
from server.calibration.routines.places import (
    Margins,
    behind_the_plug,
    half_of_label_mm,
    label_is_seen,
    reachable_places,
)
from server.calibration.routines.stand import Stand
from twin.joints import JointPosition

Array = NDArray[np.float64]

FIRST = 4
"""Places by the drawing: with the middle and the two for the wiring enough to solve."""
UNSURE = Margins(edge_px=75.0, plug_mm=22.0)
SURE = Margins(edge_px=12.0, plug_mm=8.0)


@dataclass(frozen=True, slots=True, eq=False)
class FirstLook:
    """A look with where the robot stood: at last with the label in the middle of the picture."""

    joints: JointPosition
    platform_mm: Array
    look: LabelLook


def next_places(
    stand: Stand, known: KnownBefore, first: FirstLook, looks: Sequence[LabelLook], room: int
) -> list[JointPosition]:
    """Places to go to now, in the order of little travel.

    Args:
        stand: What the routine has at hand.
        known: What is known beforehand.
        first: The look from the middle.
        looks: All so far.
        room: How many places there may still be.

    Raises:
        TooFewLooksError: the label is in the picture from fewer places.
    """
    candidates = reachable_places(stand.supervisor.geometry, first.platform_mm)
    learnt = _learnt(stand, known, looks)
    if learnt is None:
        drawn_rho = np.array(first.joints[:2])
        robot = Unknowns.guess(
            stand.supervisor.geometry, stand.R_base_camera, drawn_rho, first.look.label_mm
        )
        counted, margins, count = candidates, UNSURE, min(FIRST, room)
    else:
        robot, margins, count = learnt, SURE, room
        counted = _as_the_board_counts(stand, candidates)
    inside = _sees_the_label(stand, robot, counted, first.look.turned_rad, margins)
    candidates, counted = candidates[inside], counted[inside]
    taken = np.stack([look.rho_mm for look in looks])
    chosen = candidates[choose_places(counted, robot, known, count, taken)]
    here = stand.supervisor.telemetry.require().commanded.position
    ordered = chosen[in_travelling_order(chosen, np.array(here[:2]))]
    slide_mm = stand.supervisor.geometry.rho3.min_mm
    return [JointPosition(a, b, slide_mm) for a, b in ordered.tolist()]


def _learnt(stand: Stand, known: KnownBefore, looks: Sequence[LabelLook]) -> Unknowns | None:
    """The robot as far as the looks tell; None: they do not yet."""
    if len(looks) < FEWEST_LOOKS:
        return None
    mount = stand.settings.camera.mount.T_platform_camera[:3, :3]
    try:
        return solve_robot(looks, stand.supervisor.geometry, mount, known).unknowns
    except RobotFitDivergedError:  # the verdict on all looks will say so
        return None


def _as_the_board_counts(stand: Stand, rho_mm: Array) -> Array:
    correction = stand.supervisor.built.correction
    if correction is None:
        return rho_mm
    slide = np.full((len(rho_mm), 1), stand.supervisor.geometry.rho3.min_mm)
    return correction.to_board_many(np.hstack((rho_mm, slide)))[:, :2]


def _sees_the_label(
    stand: Stand, robot: Unknowns, rho_mm: Array, turned_rad: float, margins: Margins
) -> NDArray[np.int_]:
    """Numbers of the places from which the whole label is in the picture."""
    label_mm = robot.predict(rho_mm)
    found = np.flatnonzero(np.isfinite(label_mm).all(axis=1))
    hidden = behind_the_plug(
        stand.supervisor.geometry, stand.eye.mount, robot.R_base_camera, margins.plug_mm
    )
    seen = label_is_seen(
        label_mm[found],
        half_mm=half_of_label_mm(stand.vehicle.label_size_mm, turned_rad),
        optics=stand.eye.optics,
        edge_px=margins.edge_px,
        hidden=hidden,
    )
    return found[seen]
