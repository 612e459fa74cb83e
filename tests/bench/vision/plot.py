"""Error over distance as an SVG picture: a logarithmic scale, a curve for each method."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from html import escape

import numpy as np

WIDTH, HEIGHT = 940, 460
LEFT, RIGHT, TOP, BOTTOM = 70, 330, 46, 56
COLOURS = ("#0b6e4f", "#2a9d8f", "#c8553d", "#e09f3e", "#5b5f97", "#8d99ae", "#9c6644")

Points = Sequence[tuple[float, float]]
"""Distance [mm] and error [mm] of single pictures."""


def error_plot(title: str, methods: Mapping[str, Points]) -> str:
    """Draw every picture as a dot and the medians of six ranges as a curve."""
    distances = [distance for points in methods.values() for distance, _ in points]
    errors = [error for points in methods.values() for _, error in points if error > 0]
    near, far = math.floor(min(distances) / 50) * 50, math.ceil(max(distances) / 50) * 50
    low, high = math.floor(math.log10(min(errors))), math.ceil(math.log10(max(errors)))

    def place(distance: float, error: float) -> tuple[float, float]:
        x = LEFT + (distance - near) / (far - near) * (WIDTH - LEFT - RIGHT)
        share = (math.log10(max(error, 10.0**low)) - low) / (high - low)
        return x, HEIGHT - BOTTOM - share * (HEIGHT - TOP - BOTTOM)

    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" '
        'font-family="system-ui, sans-serif" font-size="13" fill="#222">',
        f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#fff"/>',
        f'<text x="{LEFT}" y="26" font-size="16" font-weight="600">{escape(title)}</text>',
    ]
    for decade in range(low, high + 1):
        _, y = place(near, 10.0**decade)
        parts.append(
            f'<path d="M{LEFT} {y:.1f}H{WIDTH - RIGHT}" stroke="#ddd"/>'
            f'<text x="{LEFT - 8}" y="{y + 4:.1f}" text-anchor="end">{10.0**decade:g}</text>'
        )
    for distance in range(int(near), int(far) + 1, 100):
        x, y = place(distance, 10.0**low)
        parts.append(f'<text x="{x:.1f}" y="{y + 20:.1f}" text-anchor="middle">{distance}</text>')
    parts.append(
        f'<text x="{(LEFT + WIDTH - RIGHT) / 2}" y="{HEIGHT - 14}" text-anchor="middle">'
        "distance, mm</text>"
        f'<text x="18" y="{(TOP + HEIGHT - BOTTOM) / 2}" text-anchor="middle" '
        f'transform="rotate(-90 18 {(TOP + HEIGHT - BOTTOM) / 2})">error, mm</text>'
    )
    edges = np.linspace(near, far, 7)
    for number, (name, points) in enumerate(methods.items()):
        colour = COLOURS[number % len(COLOURS)]
        dots = "".join(
            f'<circle cx="{x:.1f}" cy="{y:.1f}" r="1.6"/>' for x, y in (place(*p) for p in points)
        )
        curve = []
        for begin, end in itertools.pairwise(edges):
            inside = [error for distance, error in points if begin <= distance < end]
            if inside:
                curve.append(place((begin + end) / 2, float(np.median(inside))))
        way = " ".join(f"{x:.1f},{y:.1f}" for x, y in curve)
        y = TOP + 14 + 24 * number
        parts.append(
            f'<g fill="{colour}" opacity="0.35">{dots}</g>'
            f'<polyline points="{way}" fill="none" stroke="{colour}" stroke-width="2.5"/>'
            f'<path d="M{WIDTH - RIGHT + 20} {y}h24" stroke="{colour}" stroke-width="3"/>'
            f'<text x="{WIDTH - RIGHT + 52}" y="{y + 4}">{escape(name)}</text>'
        )
    return "\n".join((*parts, "</svg>", ""))
