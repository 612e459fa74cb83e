"""Piecewise linear tables."""

from __future__ import annotations

from bisect import bisect_right

Table = tuple[tuple[float, float], ...]
"""Rows (x, y), x ascending."""


def interpolated(table: Table, x: float) -> float:
    """Piecewise linear value of a table, constant beyond its ends."""
    index = bisect_right(table, x, key=lambda row: row[0])
    if index == 0:
        return table[0][1]
    if index == len(table):
        return table[-1][1]
    (x0, y0), (x1, y1) = table[index - 1], table[index]
    return y0 + (y1 - y0) * (x - x0) / (x1 - x0)
