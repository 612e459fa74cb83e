"""Somebody who holds the calibration board before the simulated camera, for whoever tries that."""

from __future__ import annotations

import asyncio
import math

import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from drivers.simulator import poses
from drivers.simulator.camera.camera import SimulatedCamera
from drivers.simulator.camera.held_sheet import HeldSheet, printed_sheet
from drivers.simulator.camera.imaging import ImagingParameters
from drivers.simulator.camera.textured_plane import PlaneTexture
from drivers.simulator.view import Pose
from server.labels.board_layout import BoardLayout
from server.schema.simulation import BoardCommand, HoldBoard, SimulatedBoardNow

TEXELS_PER_MM = 4
PAPER_MM = 14.0
"""White border of the sheet around the board."""

TREMOR_MM = ((0.11, 0.9), (0.05, 2.3), (0.012, 9.0))
"""Amplitudes and frequencies [Hz] of a hand that holds still."""

_RESTS = HoldBoard(down=1.2, distance_mm=900.0)
"""From there the hand comes."""

Vector = NDArray[np.float64]


class SimulatedHand:
    """The one simulated hand.

    Args:
        camera: Sees the board.
        imaging: Of paper and ink.
        layout: The board.
    """

    def __init__(
        self,
        camera: SimulatedCamera,
        imaging: ImagingParameters,
        layout: BoardLayout = BoardLayout(),  # noqa: B008 - frozen
    ) -> None:
        self._camera = camera
        self._imaging = imaging
        self._layout = layout
        self._sheet: HeldSheet | None = None
        self._from = self._to = _where(_RESTS)
        self._began_s = self._within_s = 0.0
        self._held: HoldBoard | None = None

    @property
    def now(self) -> SimulatedBoardNow:
        """What it does."""
        return SimulatedBoardNow(held=self._held)

    def carry_out(self, command: BoardCommand) -> SimulatedBoardNow:
        """Hold the board elsewhere, or put it away."""
        if isinstance(command, HoldBoard):
            self._hold(command)
        else:
            self._held = None
            self._camera.hold(None)
        return self.now

    def _hold(self, command: HoldBoard) -> None:
        now_s = asyncio.get_running_loop().time()
        before = _where(_RESTS) if self._held is None else self._at(now_s)
        self._from, self._to = before, _where(command)
        self._began_s, self._within_s = now_s, command.within_s
        self._held = command
        if self._sheet is None:
            self._sheet = HeldSheet(self._texture(), self._pose_at)
        self._camera.hold(self._sheet)

    def _at(self, t_s: float) -> Vector:
        """What ``_where`` says of the board at a time: slowly off, slowly in."""
        share = 1.0 if self._within_s == 0 else (t_s - self._began_s) / self._within_s
        share = min(max(share, 0.0), 1.0)
        return self._from + (self._to - self._from) * (share * share * (3 - 2 * share))

    def _pose_at(self, t_s: float) -> Pose:
        right, down, distance_mm, left_away, top_away, turn = self._at(t_s).tolist()
        tilt = poses.rotation_y(left_away) @ poses.rotation_x(-top_away)
        place = distance_mm * np.array([*_ahead(self._camera.optics, right, down), 1.0])
        return poses.pose(tilt @ poses.rotation_z(turn), place + _tremor_mm(t_s))

    def _texture(self) -> PlaneTexture:
        layout = self._layout
        size = [
            round(squares * layout.square_mm * TEXELS_PER_MM)
            for squares in (layout.columns, layout.rows)
        ]
        border = round(PAPER_MM * TEXELS_PER_MM)
        board = layout.board.generateImage((size[0], size[1]), marginSize=0)
        print_out = np.pad(np.asarray(board, np.uint8), border, constant_values=255)
        black, white = self._imaging.black_reflectance, self._imaging.white_reflectance
        return printed_sheet(print_out, 1 / TEXELS_PER_MM, black, white)


def _where(command: HoldBoard) -> Vector:
    """Place in the picture, distance and attitude as numbers between which a hand can move."""
    turns = (command.left_away_deg, command.top_away_deg, command.turn_deg)
    return np.array([command.right, command.down, command.distance_mm, *map(math.radians, turns)])


def _ahead(optics: CameraModel, right: float, down: float) -> tuple[float, float]:
    """Direction (x, y, 1) of a place in the picture; the lens's distortion does not matter here."""
    u_px = 0.5 * (1 + right) * (optics.width - 1)
    v_px = 0.5 * (1 + down) * (optics.height - 1)
    return (u_px - optics.cx) / optics.fx, (v_px - optics.cy) / optics.fy


def _tremor_mm(t_s: float) -> Vector:
    return np.array(
        [
            sum(size * math.sin(2 * math.pi * rate * t_s + phase) for size, rate in TREMOR_MM)
            for phase in (0.0, 1.7, 4.1)
        ]
    )
