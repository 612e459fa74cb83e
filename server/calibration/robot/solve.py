"""The fit: robust least squares with what is known beforehand (Levenberg 1944, Huber 1964).

With r_i the whitened residual of look i and p the prior, it minimises

    sum rho(|r_i|^2) + sum ((x - x0) / sigma)^2,    rho: Huber's

by reweighted Gauss-Newton steps, damped where a full one would not help.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from server.calibration.robot.errors import RobotFitDivergedError, TooFewLooksError
from server.calibration.robot.known_before import KnownBefore
from server.calibration.robot.looks import LabelLook, LookTable
from server.calibration.robot.unknowns import NAMES, Unknowns
from twin.geometry import RobotGeometry

Array = NDArray[np.float64]

FEWEST_LOOKS = 6
ROBOT_SIGMA_MM = 0.02
HUBER = 3.4
"""Length of a whitened residual (three numbers) that 1 % of honest looks exceed."""

_STEPS = 60
_SMALL_STEP = 1e-7
"""A step this small against the posterior sigma changes nothing."""


@dataclass(frozen=True, slots=True, eq=False)
class RobotSolution:
    """The built robot and how sure it is.

    Attributes:
        unknowns: The solution.
        covariance: Of the unknowns, shape (14, 14).
        residual_mm: Of each look, seen less predicted, camera frame, shape (n, 3) [mm].
        weight: Of each look, 1 down to 0 for one that does not fit, shape (n,).
    """

    unknowns: Unknowns
    covariance: Array
    residual_mm: Array
    weight: Array

    @property
    def rms_mm(self) -> float:
        """Root mean square length of the residuals across the picture [mm], by weight."""
        squares = np.sum(self.residual_mm[:, :2] ** 2, axis=1)
        return float(np.sqrt(np.average(squares, weights=self.weight)))

    def sigma_of(self, name: str) -> float:
        """Standard deviation of one unknown."""
        number = NAMES.index(name)
        return float(np.sqrt(self.covariance[number, number]))


def solve_robot(
    looks: Sequence[LabelLook],
    drawn: RobotGeometry,
    R_base_camera_drawn: Array,
    known: KnownBefore | None = None,
    *,
    robot_sigma_mm: float = ROBOT_SIGMA_MM,
) -> RobotSolution:
    """Find the built robot.

    Args:
        looks: At one label that stays where it is.
        drawn: The robot as drawn.
        R_base_camera_drawn: Attitude of the camera as drawn, shape (3, 3).
        known: What is known beforehand.
        robot_sigma_mm: How exactly the platform comes to rest, each axis.

    Raises:
        TooFewLooksError: they cannot determine that many numbers.
        RobotFitDivergedError: no robot near the drawing explains the looks.
    """
    if len(looks) < FEWEST_LOOKS:
        raise TooFewLooksError(
            f"{len(looks)} looks show the label; {FEWEST_LOOKS} are needed.", looks=len(looks)
        )
    known = known or KnownBefore()
    table = LookTable.of(looks, robot_sigma_mm)
    start = Unknowns.guess(drawn, R_base_camera_drawn, table.rho_mm[0], table.label_mm[0])
    prior = _Prior.about(start, known)
    guess, damping = prior.centre, 1e-6
    cost = _cost(guess, table, prior)
    for _ in range(_STEPS):
        normal, right, _ = _normal_equations(guess, table, prior)
        step = np.asarray(np.linalg.solve(normal + damping * np.diag(np.diag(normal)), right))
        tried = guess.stepped(step)
        tried_cost = _cost(tried, table, prior)
        if not tried_cost <= cost:  # also where the legs cannot close
            damping *= 10
            if damping > 1e6:
                break
            continue
        moved = np.sqrt(float(step @ normal @ step))
        guess, cost, damping = tried, tried_cost, max(damping / 10, 1e-12)
        if moved < _SMALL_STEP:
            break
    if not np.isfinite(cost):
        raise RobotFitDivergedError("No robot near the drawing could have seen the label so.")
    normal, _, weight = _normal_equations(guess, table, prior)
    return RobotSolution(
        guess,
        np.asarray(np.linalg.inv(normal)),
        table.label_mm - guess.predict(table.rho_mm),
        weight,
    )


@dataclass(frozen=True, slots=True, eq=False)
class _Prior:
    """What is known beforehand, as observations of the unknowns themselves."""

    centre: Unknowns
    information: Array

    @classmethod
    def about(cls, start: Unknowns, known: KnownBefore) -> _Prior:
        values = start.values.copy()
        for name, scale in zip(("left_scale", "right_scale"), known.scales, strict=True):
            values[NAMES.index(name)] = scale
        centre = Unknowns(start.drawn, start.R_base_camera_drawn, values)
        return cls(centre, 1.0 / known.sigma**2)

    def off(self, guess: Unknowns) -> Array:
        return guess.values - self.centre.values


def _cost(guess: Unknowns, table: LookTable, prior: _Prior) -> float:
    try:
        length = np.linalg.norm(_whitened(guess, table), axis=1)
    except ValidationError:  # a step led to a robot that cannot be
        return math.inf
    huber = np.where(length <= HUBER, length**2, 2 * HUBER * length - HUBER**2)
    off = prior.off(guess)
    return float(np.sum(huber) + np.sum(prior.information * off**2))


def _whitened(guess: Unknowns, table: LookTable) -> Array:
    residual = table.label_mm - guess.predict(table.rho_mm)
    return np.asarray(np.einsum("nij,nj->ni", table.whitening, residual))


def _normal_equations(
    guess: Unknowns, table: LookTable, prior: _Prior
) -> tuple[Array, Array, Array]:
    """Information matrix, right side, and the weight of each look."""
    residual = _whitened(guess, table)
    design = np.einsum("nij,njk->nik", table.whitening, guess.derivatives(table.rho_mm))
    length = np.linalg.norm(residual, axis=1)
    weight = np.minimum(1.0, HUBER / np.maximum(length, HUBER))
    normal = np.einsum("n,nij,nik->jk", weight, design, design)
    right = np.einsum("n,nij,ni->j", weight, design, residual)
    normal[np.diag_indices_from(normal)] += prior.information
    return normal, right - prior.information * prior.off(guess), weight
