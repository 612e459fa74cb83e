"""Differential evolution with constraints, whole populations at a time.

R. Storn, K. Price, "Differential Evolution", J. Global Optimization 11 (1997): rand/1/bin with a
scale drawn anew for each generation. Constraints by the rules of K. Deb, "An efficient constraint
handling method for genetic algorithms" (2000): a feasible point beats an infeasible one, of two
infeasible ones the less violating wins, of two feasible ones the better. SciPy has the method, too,
but would be the largest requirement of the project by far, for this one page.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Scores(NamedTuple):
    """What many points are worth.

    Attributes:
        objective: To be made small, shape (N,).
        violation: 0 where a point is feasible, greater the further it is from it, shape (N,).
    """

    objective: Array
    violation: Array


Evaluate = Callable[[Array], Scores]
"""Scores of points in the unit cube, shape (N, D)."""

POPULATION = 48
CROSSOVER = 0.9
SCALE = (0.4, 0.9)


def better(new: Scores, old: Scores) -> NDArray[np.bool_]:
    """Where a new point wins against an old one, by Deb's rules; a tie lets the new one in."""
    closer = new.violation < old.violation
    level = new.violation == old.violation
    wins: NDArray[np.bool_] = closer | (level & (new.objective <= old.objective))
    return wins


def best_of(scores: Scores) -> int:
    """Index of the best point by the same rules."""
    return int(np.lexsort((scores.objective, scores.violation))[0])


def evolve(
    evaluate: Evaluate,
    dimensions: int,
    *,
    seed: int,
    generations: int,
    on_generation: Callable[[], None] = lambda: None,
) -> Array:
    """Best point of the unit cube that was found, shape (D,).

    Args:
        evaluate: Scores of points.
        dimensions: D.
        seed: The same seed finds the same point.
        generations: How long to look.
        on_generation: Called after each generation, for a progress bar.
    """
    chance = np.random.default_rng(seed)
    points = chance.random((POPULATION, dimensions))
    scores = evaluate(points)
    rows = np.arange(POPULATION)
    for _ in range(generations):
        # three others for each point: distinct ranks of a random order, none of them its own
        order = np.argsort(chance.random((POPULATION, POPULATION - 1)), axis=1)[:, :3]
        a, b, c = (order + (order >= rows[:, np.newaxis])).T
        scale = chance.uniform(*SCALE)
        mutants = _reflected(points[a] + scale * (points[b] - points[c]))
        crossed = chance.random(points.shape) < CROSSOVER
        crossed[rows, chance.integers(dimensions, size=POPULATION)] = True
        trials = np.where(crossed, mutants, points)
        trial_scores = evaluate(trials)
        wins = better(trial_scores, scores)
        points = np.where(wins[:, np.newaxis], trials, points)
        scores = Scores(
            np.where(wins, trial_scores.objective, scores.objective),
            np.where(wins, trial_scores.violation, scores.violation),
        )
        on_generation()
    best: Array = points[best_of(scores)]
    return best


def _reflected(points: Array) -> Array:
    """Points outside the cube come back in, as far from its wall as they were beyond it."""
    folded = np.abs(points)
    return np.clip(np.where(folded > 1, 2 - folded, folded), 0.0, 1.0)
