"""The last part of a fit: all edges, short profiles, light, blur and bend taken out."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.vision.fitting.bend_choice import BendChoice, chosen_bend
from server.vision.fitting.bending import possible_bends
from server.vision.fitting.blurred_code import BlurredCode
from server.vision.fitting.code_edges import CodeEdges
from server.vision.fitting.covered_edges import AGREES, covered_edges
from server.vision.fitting.edge_profiles import EdgeOffsets, edge_offsets
from server.vision.fitting.edge_spread import spread_basis
from server.vision.fitting.light_field import LightField, light_field
from server.vision.fitting.light_picture import LightPicture
from server.vision.fitting.measured_blur import blurred_as_seen
from server.vision.fitting.robust_step import RobustStep, robust_step
from server.vision.projection import Array, perturbed

BLUR_LOOKS = 2
"""So often the blur of a blurred picture is measured at most: again only where the pose was still
off by more than a short step when it was measured, for its kernel is symmetric, so that a small
shift changes it by the square of that shift only."""

_FLOWING_MODULES = 0.18
"""Blur (standard deviation across the edges of one direction) from which on neighbours count."""

_SHORT_MODULES, _LEAST_SHORT_PX, _MOST_SHORT_PX = 0.01, 0.05, 0.1
"""The step after one so short is a tenth to a thirtieth of it, and would change nothing."""

_PROFILE_WIDTHS = 3.0
_LEAST_REACH_PX = 2.0


class FineFit:
    """Gauss-Newton over pose, spread and whatever else turns out to be unknown.

    Args:
        picture: The light around the label.
        camera: Intrinsics and distortion.
        edges: Edges of the code.
        T_camera_label: Pose within a fraction of a module, shape (4, 4) [mm].
        spread_px: Edge spread there.
        few: The edges that led there ...
        measured: ... and what was measured of them.
        inverted: The code is white on black.
        moving: Its way per row is unknown, too.
    """

    def __init__(
        self,
        picture: LightPicture,
        camera: CameraModel,
        edges: CodeEdges,
        T_camera_label: Array,
        *,
        spread_px: float,
        few: CodeEdges,
        measured: EdgeOffsets,
        inverted: bool,
        moving: bool,
    ) -> None:
        self._picture, self._camera, self._edges = picture, camera, edges
        self._inverted, self._moving = inverted, moving
        self.pose = T_camera_label
        self._basis = spread_basis(edges)
        self._spread = np.zeros(len(self._basis))
        self._spread[0] = spread_px
        self._row_way = np.zeros(2)
        # Longer profiles than the blur only collect noise.
        self._reach_px = max(_PROFILE_WIDTHS * measured.width_px(), _LEAST_REACH_PX)
        self.measured = measured
        self._light = light_field(few, measured)
        self._levels = None if self._light is None else self._light.levels(edges)
        self._blurred: BlurredCode | None = None
        self._bend: BendChoice | None = None
        self._covered: NDArray[np.bool_] | None = None
        self._agreed_beside_cover = 0
        self.before_cover: RobustStep | None = None
        """The last step with the edges beside a cover, if there is one."""
        self._most_bend_px = 0.0
        self.bend_px = 0.0
        """Largest shift of an edge because the label is not flat, with a cover or without."""
        flows = _neighbours_flow_in(measured, few.upright, self._module_px)
        self._looks = BLUR_LOOKS if flows and self._light is not None else 0
        self._moved_since_look = True

    @property
    def bend_doubt(self) -> Array | None:
        """Covariance of (omega, tau) for not knowing how the label is bent; None: it is flat."""
        return None if self._bend is None else self._bend.doubt

    @property
    def spread_px(self) -> float:
        """Edge spread in the code's middle."""
        return float(self._spread[0])

    def inlier_share(self, solved: RobustStep) -> float:
        """Share of the edges that agree with a step, 0 to 1.

        Edges beside a cover that seemed to agree before they were left out are among them.
        """
        agreeing = int(np.count_nonzero(solved.weights > AGREES)) + self._agreed_beside_cover
        return agreeing / len(self._edges.points_mm)

    @property
    def _module_px(self) -> float:
        return self._camera.fx * self._edges.module_mm / float(self.pose[2, 3])

    @property
    def short_px(self) -> float:
        """A step that moves no edge farther is the last."""
        return float(np.clip(_SHORT_MODULES * self._module_px, _LEAST_SHORT_PX, _MOST_SHORT_PX))

    def step(self) -> tuple[RobustStep, float] | None:
        """One step, and how far it moved the farthest edge [px]; None where it leads nowhere."""
        spread_px = self._spread @ self._basis
        measured = edge_offsets(
            self._picture,
            self._camera,
            self._edges,
            self.pose,
            inverted=self._inverted,
            spread_px=spread_px,
            reach_px=self._reach_px,
            levels=self._levels,
            row_way=self._row_way if self._moving else None,
            expected=self._blurred,
        )
        if self._covered is not None:
            measured = measured._replace(visible=measured.visible & ~self._covered)
        self.measured = measured
        others = [self._basis]
        if self._moving:
            others.append(self.measured.by_row_way)
        lasting = 6 + sum(len(rows) for rows in others)
        bent = None if self._bend is None else self._bend.by_heights
        if bent is not None:
            others.append(bent)  # always told anew, for the profiles stay where they are
        solved = robust_step(self.measured, spread_px, np.concatenate(others), self._edges.upright)
        if solved is None:
            return None
        self.pose = perturbed(self.pose, solved.step[:6])
        self._spread = self._spread + solved.step[6 : 6 + len(self._spread)]
        if self._moving:
            self._row_way = self._row_way + solved.step[lasting - 2 : lasting]
        bend = solved.design[:, lasting:] @ solved.step[lasting:]
        self.bend_px = float(np.max(np.abs(bend), initial=self._most_bend_px))
        moved_px = solved.moved_px(lasting)
        self._moved_since_look |= moved_px > self.short_px
        return solved, moved_px

    def learn(self, solved: RobustStep) -> bool:
        """After a short step: see what the picture holds besides; whether to go on stepping."""
        if self._looks > 0 and self._moved_since_look:
            self._looks, self._moved_since_look = self._looks - 1, False
            light = light_field(self._edges, self.measured)
            if light is not None:
                self._measure_blur(light)
                return True
        if self._bend is None:
            self._bend = self._told_bend(solved)
            if self._bend is not None and self._bend.by_heights is not None:
                return True
        if self.before_cover is None:
            covered = covered_edges(self._edges, solved)
            if covered is not None:
                self._leave_out(covered, solved)
                return True
        return False

    def _leave_out(self, covered: NDArray[np.bool_], solved: RobustStep) -> None:
        """Go on without the edges beside a cover, which may have looked like a bend."""
        self.before_cover, self._covered, self._bend = solved, covered, None
        self._most_bend_px = self.bend_px
        self._agreed_beside_cover = int(
            np.count_nonzero(covered[solved.used] & (solved.weights > AGREES))
        )
        clear = self.measured._replace(visible=self.measured.visible & ~covered)
        light = light_field(self._edges, clear)
        if light is not None:
            self._levels = light.levels(self._edges)

    def _told_bend(self, solved: RobustStep) -> BendChoice | None:
        """Whether and how the label is bent; None where it is plainly flat."""
        bends = possible_bends(solved, self.measured, self._edges, self.pose)
        if not bends:
            return None
        spread_px, others = self._spread @ self._basis, [self._basis]
        if self._moving:
            others.append(self.measured.by_row_way)

        def solve(bend: Array) -> RobustStep | None:
            columns = np.concatenate((*others, bend))
            return robust_step(self.measured, spread_px, columns, self._edges.upright)

        return chosen_bend(bends, solved, solve)

    def _measure_blur(self, light: LightField) -> None:
        self._levels = light.levels(self._edges)
        self._blurred = blurred_as_seen(
            self._picture,
            self._camera,
            self._edges,
            self.pose,
            light,
            inverted=self._inverted,
            row_way=self._row_way if self._moving else None,
        )


def _neighbours_flow_in(
    measured: EdgeOffsets, upright: NDArray[np.bool_], module_px: float
) -> bool:
    """Whether blur or motion carry the light of one module's edges to those of the next."""
    widest_px = max(measured.width_px(upright), measured.width_px(~upright))
    return widest_px > _FLOWING_MODULES * module_px
