"""Robots as they come out of a workshop, and what their cameras see."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import cv2
import numpy as np
from numpy.typing import NDArray

from server.calibration.robot.common_effects import EFFECTS, common_effects, effect_sigmas
from server.calibration.robot.known_before import KnownBefore
from server.calibration.robot.looks import LabelLook
from server.calibration.robot.unknowns import MECHANISM, NAMES, mechanism_values
from twin.as_built import PlanarAsBuilt
from twin.camera_mount import CameraMount
from twin.geometry import RobotGeometry
from twin.kinematics import alpha

Array = NDArray[np.float64]

DRAWN = RobotGeometry()
R_DRAWN = CameraMount().T_platform_camera[:3, :3]
BUILT_WITHIN = np.array([3, 3, 3, 3, 3, 3, math.radians(0.5), math.radians(0.5), 0.005, 0.005])
CAMERA_WITHIN_RAD = math.radians(3.0)
PICTURE_MM = np.diag([0.01, 0.01, 0.05])
REST_MM = 0.02
LENS_RAD = KnownBefore().lens_sigma_rad
MEASURED_SCALE = 0.0004
MEASURED_LABEL = 0.0017


@dataclass(frozen=True, slots=True, eq=False)
class Workshop:
    """One robot drawn at random."""

    built: PlanarAsBuilt
    R_base_camera: Array
    way_mm: Array
    label_ratio: float
    known: KnownBefore
    rng: np.random.Generator
    rest_mm: float = REST_MM
    picture_mm: Array = field(default_factory=PICTURE_MM.copy)
    effects: Array = field(default_factory=lambda: np.zeros(EFFECTS))

    @classmethod
    def robot(cls, seed: int) -> Workshop:
        rng = np.random.default_rng(seed)
        built = PlanarAsBuilt.from_vector(
            PlanarAsBuilt.as_drawn(DRAWN).vector + BUILT_WITHIN * rng.uniform(-1, 1, 10)
        )
        turn = cv2.Rodrigues(CAMERA_WITHIN_RAD * rng.uniform(-1, 1, 3))[0]
        left, right = np.array([built.left_scale, built.right_scale]) + MEASURED_SCALE * (
            rng.normal(size=2)
        )
        return cls(
            built,
            turn @ R_DRAWN,
            np.array([650.0, 335.0, 290.0]) + rng.uniform(-40, 40, 3) * (1, 1, 0.25),
            1.0 + MEASURED_LABEL * rng.normal(),
            KnownBefore(
                left_scale=left,
                right_scale=right,
                scale_sigma=MEASURED_SCALE,
                label_ratio_sigma=MEASURED_LABEL,
            ),
            rng,
        )

    @classmethod
    def sagging(
        cls, seed: int, rest_mm: float = 0.01, lens_sigma_rad: float = LENS_RAD
    ) -> Workshop:
        """The same robot, sagging, with a sharp camera before a label that is not flat."""
        chance = np.random.default_rng((seed, 1)).normal(size=EFFECTS)
        robot = cls.robot(seed)
        known = robot.known.model_copy(update={"lens_sigma_rad": lens_sigma_rad})
        return replace(
            robot,
            known=known,
            rest_mm=rest_mm,
            picture_mm=0.2 * PICTURE_MM,
            effects=effect_sigmas(lens_sigma_rad) * chance,
        )

    def look(self, rho_mm: Array, *, label_moved_mm: float = 0.0) -> LabelLook:
        """One look, with the camera's noise and the robot's play."""
        platform = self.built.forward_many(rho_mm) + self.rest_mm * self.rng.normal(size=2)
        way = self.way_mm + np.array([label_moved_mm, 0.0, 0.0])
        way[:2] -= platform
        seen = self.R_base_camera.T @ way / self.label_ratio
        shared = common_effects(seen[None], platform[None], self.R_base_camera, DRAWN.regular_box)[
            0
        ]
        seen = seen + shared @ self.effects + self.picture_mm @ self.rng.normal(size=3)
        return LabelLook(rho_mm, seen, self.picture_mm**2)

    def looks(self, count: int = 25) -> list[LabelLook]:
        """From random places over the box."""
        places = np.array([650.0, 335.0]) + self.rng.uniform(-1, 1, (count, 2)) * (130, 100)
        return [self.look(rho) for rho in alpha.inverse_many(DRAWN, places)]

    def error_mm(self, believed: PlanarAsBuilt) -> Array:
        """How far the platform misses places of the box, shifted and turned as suits best."""
        grid = np.linspace(-100.0, 100.0, 9)
        wanted = np.stack(np.meshgrid(grid, grid), axis=-1).reshape(-1, 2)
        rho = believed.inverse_many(wanted + np.array([650.0, 335.0]))
        off = self.built.forward_many(rho) - np.array([650.0, 335.0]) - wanted
        off -= off.mean(axis=0)
        across = np.column_stack((-wanted[:, 1], wanted[:, 0]))
        off -= across * np.sum(across * off) / np.sum(across**2)
        return np.asarray(np.linalg.norm(off, axis=1))


def truth_of(robot: Workshop) -> Array:
    """The unknowns of a robot in the frame of the solution; NaN where they are not asked for."""
    values = np.full(len(NAMES), np.nan)
    values[MECHANISM] = mechanism_values(robot.built, DRAWN)
    return values
