"""The fit: robust least squares with what is known beforehand (Levenberg 1944, Huber 1964).

With r_i the whitened residual of look i, e the effects that all looks share (`common_effects`) and
p the prior of both, it minimises

    sum rho(|r_i|^2) + sum ((x - x0) / sigma)^2,    rho: Huber's

by reweighted Gauss-Newton steps, damped where a full one would not help.

How exactly a robot comes to rest, no drawing tells: one moves by whole steps of its motors,
another sticks. The looks tell it by what they scatter across the line of sight beyond what the fit
has eaten up (`_rest_sigma_mm`).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from server.calibration.robot.common_effects import EFFECTS, common_effects, effect_sigmas
from server.calibration.robot.errors import RobotFitDivergedError, TooFewLooksError
from server.calibration.robot.known_before import KnownBefore
from server.calibration.robot.looks import LabelLook, LookTable
from server.calibration.robot.unknowns import NAMES, Unknowns
from twin.geometry import RobotGeometry

Array = NDArray[np.float64]

FEWEST_LOOKS = 6
REST_SIGMAS_MM = (0.002, 0.02)
"""A robot comes to rest no better than to half a step of its motors, and where it scatters more
than that largest number, something is loose: then looks are left out rather than believed less."""
HUBER = 3.4
"""Length of a whitened residual (three numbers) that 1 % of honest looks exceed."""
FITS = 0.5
"""A look of less weight does not fit to the others."""

_FEET = NAMES.index("right_foot_x_mm")
_STEPS = 60
_SMALL_STEP = 1e-7
"""A step this small against the posterior sigma changes nothing."""
_FEWEST_LEFT = 10
"""Numbers that must be left over before they say how exactly the robot comes to rest."""
_LESS_SURE = 4
"""Of n numbers that are left over so many count no more. The scatter is estimated, so an ellipsoid
of seven numbers must be larger by F(7, n) over chi squared to hold 95 % (Hotelling 1931): that is
n / (n - 4) to 2 % from n = 15 on."""
_REST_ROUNDS, _REST_SETTLED = 4, 0.05


@dataclass(frozen=True, slots=True, eq=False)
class RobotSolution:
    """The built robot and how sure it is.

    Attributes:
        unknowns: The solution.
        shared: What all looks share, in the order of `common_effects`, shape (16,).
        covariance: Of the unknowns, as the robot is once it was homed again, shape (14, 14).
        residual_mm: Of each look, seen less predicted, camera frame, shape (n, 3) [mm].
        weight: Of each look, 1 down to 0 for one that does not fit, shape (n,).
        rest_sigma_mm: How exactly the platform came to rest, along each axis.
    """

    unknowns: Unknowns
    shared: Array
    covariance: Array
    residual_mm: Array
    weight: Array
    rest_sigma_mm: float

    @property
    def rms_mm(self) -> float:
        """Root mean square length of the residuals across the picture [mm], by weight."""
        squares = np.sum(self.residual_mm[:, :2] ** 2, axis=1)
        return float(np.sqrt(np.average(squares, weights=self.weight)))

    def sigma_of(self, name: str) -> float:
        """Standard deviation of one unknown."""
        number = NAMES.index(name)
        return float(np.sqrt(self.covariance[number, number]))

    def residual_of(self, looks: Sequence[LabelLook]) -> Array:
        """Seen less predicted of any looks at the same label, shape (n, 3) [mm]."""
        table = LookTable.of(looks)
        fitted = _Fit(self.unknowns, self.shared)
        return fitted.residual(table, _effects_at(table, self.unknowns))


def solve_robot(
    looks: Sequence[LabelLook],
    drawn: RobotGeometry,
    R_base_camera_drawn: Array,
    known: KnownBefore | None = None,
) -> RobotSolution:
    """Find the built robot.

    Args:
        looks: At one label that stays where it is.
        drawn: The robot as drawn.
        R_base_camera_drawn: Attitude of the camera as drawn, shape (3, 3).
        known: What is known beforehand.

    Raises:
        TooFewLooksError: they cannot determine that many numbers.
        RobotFitDivergedError: no robot near the drawing explains the looks.
    """
    if len(looks) < FEWEST_LOOKS:
        raise TooFewLooksError(
            f"{len(looks)} looks show the label; {FEWEST_LOOKS} are needed.", looks=len(looks)
        )
    table = LookTable.of(looks)
    start = Unknowns.guess(drawn, R_base_camera_drawn, table.rho_mm[0], table.label_mm[0])
    known = known or KnownBefore()
    prior = _Prior.about(start, known)
    # the effects are so small that a look a few millimetres beside its place feels the same ones
    effects = _effects_at(table, start)
    fit = _Fit(prior.centre, np.zeros(EFFECTS))
    rest_sigma_mm = REST_SIGMAS_MM[1]
    for _ in range(_REST_ROUNDS):
        data = _Data(table, effects, table.whitening(rest_sigma_mm))
        fit = _fitted(fit, data, prior)
        found_mm = _rest_sigma_mm(fit, data, prior, rest_sigma_mm)
        if abs(found_mm - rest_sigma_mm) <= _REST_SETTLED * rest_sigma_mm:
            break
        rest_sigma_mm = found_mm
    normal, _, weight = _normal_equations(fit, data, prior)
    covariance = np.asarray(np.linalg.inv(normal))[: len(NAMES), : len(NAMES)]
    # both carriages count from switches, which the next homing finds a little elsewhere
    covariance[_FEET, _FEET] += 2.0 * known.switch_sigma_mm**2
    return RobotSolution(
        fit.unknowns,
        fit.shared,
        covariance,
        fit.residual(table, effects),
        weight,
        rest_sigma_mm,
    )


@dataclass(frozen=True, slots=True, eq=False)
class _Fit:
    """A guess of everything that is solved for."""

    unknowns: Unknowns
    shared: Array

    def stepped(self, step: Array) -> _Fit:
        count = len(NAMES)
        return _Fit(self.unknowns.stepped(step[:count]), self.shared + step[count:])

    def residual(self, table: LookTable, effects: Array) -> Array:
        """Seen less predicted, shape (n, 3) [mm]."""
        predicted = self.unknowns.predict(table.rho_mm) + effects @ self.shared
        return np.asarray(table.label_mm - predicted)


@dataclass(frozen=True, slots=True, eq=False)
class _Data:
    """Looks, what they share, and their whitening."""

    table: LookTable
    effects: Array
    whitening: Array

    def whitened(self, fit: _Fit) -> Array:
        residual = fit.residual(self.table, self.effects)
        return np.asarray(np.einsum("nij,nj->ni", self.whitening, residual))

    def design(self, fit: _Fit) -> Array:
        """Derivatives of what is predicted, not whitened, shape (n, 3, 30)."""
        by_unknowns = fit.unknowns.derivatives(self.table.rho_mm)
        return np.concatenate((by_unknowns, self.effects), axis=2)


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
        sigma = np.concatenate((known.sigma, effect_sigmas(known.lens_sigma_rad)))
        centre = Unknowns(start.drawn, start.R_base_camera_drawn, values)
        return cls(centre, 1.0 / sigma**2)

    def off(self, fit: _Fit) -> Array:
        return np.concatenate((fit.unknowns.values - self.centre.values, fit.shared))


def _fitted(fit: _Fit, data: _Data, prior: _Prior) -> _Fit:
    damping, cost = 1e-6, _cost(fit, data, prior)
    for _ in range(_STEPS):
        normal, right, _ = _normal_equations(fit, data, prior)
        step = np.asarray(np.linalg.solve(normal + damping * np.diag(np.diag(normal)), right))
        tried = fit.stepped(step)
        tried_cost = _cost(tried, data, prior)
        if not tried_cost <= cost:  # also where the legs cannot close
            damping *= 10
            if damping > 1e6:
                break
            continue
        moved = np.sqrt(float(step @ normal @ step))
        fit, cost, damping = tried, tried_cost, max(damping / 10, 1e-12)
        if moved < _SMALL_STEP:
            break
    if not np.isfinite(cost):
        raise RobotFitDivergedError("No robot near the drawing could have seen the label so.")
    return fit


def _effects_at(table: LookTable, unknowns: Unknowns) -> Array:
    platform_mm = unknowns.built.forward_many(table.rho_mm)
    box = unknowns.drawn.regular_box
    return common_effects(table.label_mm, platform_mm, unknowns.R_base_camera, box)


def _cost(fit: _Fit, data: _Data, prior: _Prior) -> float:
    try:
        length = np.linalg.norm(data.whitened(fit), axis=1)
    except ValidationError:  # a step led to a robot that cannot be
        return math.inf
    huber = np.where(length <= HUBER, length**2, 2 * HUBER * length - HUBER**2)
    off = prior.off(fit)
    return float(np.sum(huber) + np.sum(prior.information * off**2))


def _normal_equations(fit: _Fit, data: _Data, prior: _Prior) -> tuple[Array, Array, Array]:
    """Information matrix, right side, and the weight of each look."""
    residual = data.whitened(fit)
    design = np.einsum("nij,njk->nik", data.whitening, data.design(fit))
    length = np.linalg.norm(residual, axis=1)
    weight = np.minimum(1.0, HUBER / np.maximum(length, HUBER))
    normal = np.einsum("n,nij,nik->jk", weight, design, design)
    right = np.einsum("n,nij,ni->j", weight, design, residual)
    normal[np.diag_indices_from(normal)] += prior.information
    return normal, right - prior.information * prior.off(fit), weight


def _rest_sigma_mm(fit: _Fit, data: _Data, prior: _Prior, assumed_mm: float) -> float:
    """How exactly the platform comes to rest, by what fitting looks scatter across the sight.

    With A the design across the sight, C the covariance and s what was assumed, each residual has
    lost the share tr(A C A^T) / s^2 of its two numbers to the fit.
    """
    normal, _, weight = _normal_equations(fit, data, prior)
    fits = weight >= FITS
    if 2 * fits.sum() < _FEWEST_LEFT:
        return assumed_mm
    across = data.table.across[fits]
    off = np.einsum("nij,nj->ni", across, fit.residual(data.table, data.effects)[fits])
    design = across @ data.design(fit)[fits]
    pictures = np.einsum("nij,nji->", across, data.table.covariance_mm2[fits]) / (2 * len(off))
    eaten = np.einsum("nij,jk,nik->", design, np.linalg.inv(normal), design)
    left = 2 * len(off) - float(eaten) / (assumed_mm**2 + pictures)
    if left < _FEWEST_LEFT:
        return assumed_mm
    scatter = float(np.sum(off**2)) / (left - _LESS_SURE) - pictures
    return float(np.clip(math.sqrt(max(scatter, 0.0)), *REST_SIGMAS_MM))
