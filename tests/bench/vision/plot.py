"""Errors over distance as an SVG picture: a panel for each kind, a curve for each method."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from html import escape

import numpy as np

WIDTH, PANEL_HEIGHT = 940, 330
LEFT, RIGHT, TOP, BOTTOM = 76, 320, 44, 20
FOOT = 40
COLOURS = ("#0b6e4f", "#35b39b", "#c8553d", "#e09f3e", "#5b5f97", "#8d99ae", "#9c6644")
RANGES = 6

Points = Sequence[tuple[float, float]]
"""Distance [mm] and error [mm] of single pictures."""


def error_plot(panels: Mapping[str, Mapping[str, Points]]) -> str:
    """Draw every picture as a dot, and the medians of some ranges of distance as a curve.

    Args:
        panels: By their titles, from top to bottom: what each method did.
    """
    height = PANEL_HEIGHT * len(panels) + FOOT
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" '
        'font-family="system-ui, sans-serif" font-size="13" fill="#222">',
        f'<rect width="{WIDTH}" height="{height}" fill="#fff"/>',
    ]
    for number, (title, methods) in enumerate(panels.items()):
        parts.append(f'<g transform="translate(0 {number * PANEL_HEIGHT})">')
        parts += _panel(title, methods)
        parts.append("</g>")
    parts += _legend(next(iter(panels.values())))
    middle = (LEFT + WIDTH - RIGHT) / 2
    parts.append(
        f'<text x="{middle}" y="{height - 12}" text-anchor="middle">distance, mm</text></svg>\n'
    )
    return "\n".join(parts)


def _panel(title: str, methods: Mapping[str, Points]) -> list[str]:
    distances = [distance for points in methods.values() for distance, _ in points]
    errors = [error for points in methods.values() for _, error in points if error > 0]
    near, far = math.floor(min(distances) / 50) * 50, math.ceil(max(distances) / 50) * 50
    low = math.floor(math.log10(float(np.percentile(errors, 1))))
    high = math.ceil(math.log10(max(errors)))
    bottom = PANEL_HEIGHT - BOTTOM

    def place(distance: float, error: float) -> tuple[float, float]:
        x = LEFT + (distance - near) / (far - near) * (WIDTH - LEFT - RIGHT)
        share = (math.log10(max(error, 10.0**low)) - low) / (high - low)
        return x, bottom - share * (bottom - TOP)

    parts = [f'<text x="{LEFT}" y="28" font-size="16" font-weight="600">{escape(title)}</text>']
    for decade in range(low, high + 1):
        _, y = place(near, 10.0**decade)
        parts.append(
            f'<path d="M{LEFT} {y:.1f}H{WIDTH - RIGHT}" stroke="#ddd"/>'
            f'<text x="{LEFT - 8}" y="{y + 4:.1f}" text-anchor="end">{10.0**decade:g}</text>'
        )
    for distance in range(int(near), int(far) + 1, 100):
        x, y = place(distance, 10.0**low)
        parts.append(
            f'<path d="M{x:.1f} {y:.1f}v4" stroke="#999"/>'
            f'<text x="{x:.1f}" y="{y + 18:.1f}" text-anchor="middle">{distance}</text>'
        )
    edges = np.geomspace(near, far, RANGES + 1)
    dots, curves = [], []
    for colour, points in zip(COLOURS, methods.values(), strict=False):
        circles = (place(*point) for point in points)
        dots.append(f'<g fill="{colour}" opacity="0.3">')
        dots += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="1.7"/>' for x, y in circles]
        dots.append("</g>")
        curve = []
        for begin, end in itertools.pairwise(edges):
            inside = [error for distance, error in points if begin <= distance < end]
            if inside:
                curve.append(place(math.sqrt(begin * end), float(np.median(inside))))
        way = " ".join(f"{x:.1f},{y:.1f}" for x, y in curve)
        curves.append(
            f'<polyline points="{way}" fill="none" stroke="{colour}" stroke-width="2.5"/>'
        )
    return parts + dots + curves


def _legend(names: Mapping[str, object]) -> list[str]:
    parts = []
    for number, (colour, name) in enumerate(zip(COLOURS, names, strict=False)):
        y = TOP + 14 + 24 * number
        parts.append(
            f'<path d="M{WIDTH - RIGHT + 20} {y}h24" stroke="{colour}" stroke-width="3"/>'
            f'<text x="{WIDTH - RIGHT + 52}" y="{y + 4}">{escape(name)}</text>'
        )
    y = TOP + 26 + 24 * len(names)
    parts.append(
        f'<text x="{WIDTH - RIGHT + 20}" y="{y}" fill="#666">a dot is a picture, a curve the '
        "medians</text>"
    )
    return parts
