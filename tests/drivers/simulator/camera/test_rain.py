"""Drops on the car, on the label and on the glass."""

from __future__ import annotations

import numpy as np
import pytest

from drivers.camera import CameraModel
from drivers.simulator.camera.coarse_grid import CoarseGrid
from drivers.simulator.camera.conditions import FLAWLESS, RainConditions
from drivers.simulator.camera.imaging import ImagingParameters
from drivers.simulator.camera.rain_drops import drops_on, lens_drop_cover
from drivers.simulator.camera.renderer import Renderer
from tests.drivers.simulator.camera.scenes import pose, view

OPTICS = CameraModel(width=640, height=480, fx=530.0, fy=530.0, cx=319.5, cy=239.5)
GRID = CoarseGrid(OPTICS, 8)


def test_without_rain_there_are_no_drops() -> None:
    rng = np.random.default_rng(1)
    assert drops_on((80.0, 80.0), RainConditions(), rng, cells_per_mm=4.0) is None
    assert lens_drop_cover(ImagingParameters(), RainConditions(), GRID, rng) is None


def test_as_many_drops_fall_as_are_asked_for() -> None:
    rain = RainConditions(drops_per_dm2=5.0, drop_mm=1.0)
    drops = drops_on((400.0, 400.0), rain, np.random.default_rng(1), cells_per_mm=2.0)
    assert drops is not None
    covered_mm2 = float(np.mean(drops.inside)) * 400.0**2
    # 80 drops of 1 mm, with their spread of sizes and the least size that can be drawn
    assert 40 < covered_mm2 < 220


def test_a_drop_magnifies_what_lies_under_it_and_leaves_the_rest() -> None:
    rain = RainConditions(drops_per_dm2=12.0, drop_mm=6.0)
    drops = drops_on((80.0, 80.0), rain, np.random.default_rng(5), cells_per_mm=4.0)
    assert drops is not None
    ramp = np.tile(np.linspace(0, 1, 320, dtype=np.float32), (320, 1))
    seen = drops.seen_through(ramp)
    dry = drops.inside == 0
    assert np.abs(seen - ramp)[dry].max() < 0.02
    wet = drops.inside > 0.99
    assert wet.any()
    slope = np.diff(seen - drops.shine, axis=1)[wet[:, 1:] & wet[:, :-1]]
    assert 0.5 / 320 < float(np.median(slope)) < 0.95 / 320


def test_a_drop_on_the_glass_covers_the_share_of_the_aperture_that_it_hides() -> None:
    """Brute force: rays through points of the aperture, counted where they pass the drop."""
    imaging = ImagingParameters()
    rain = RainConditions(lens_drops=1, lens_drop_mm=2.0)
    cover = lens_drop_cover(imaging, rain, GRID, np.random.default_rng(3))
    assert cover is not None
    rng = np.random.default_rng(3)
    reach = np.abs(GRID.rays).reshape(-1, 2).max(axis=0) * rain.glass_mm
    place = rng.uniform(-1, 1, size=(1, 2))[0] * reach
    radius = float(1.0 * np.clip(rng.lognormal(-0.1, 0.4, 1), 0.3, 3)[0])
    angle, r = rng.uniform(0, 2 * np.pi, 4000), 0.76 * np.sqrt(rng.uniform(size=4000))
    lens = np.column_stack((r * np.cos(angle), r * np.sin(angle)))
    for node in ((10, 12), (30, 40), (50, 70)):
        ray = GRID.rays[node] * rain.glass_mm
        share = np.mean(np.hypot(*(ray + lens - place).T) < radius)
        assert cover[node] == pytest.approx(share, abs=0.03)
    assert float(cover.max()) > 0.9


def test_drops_on_the_glass_take_contrast_and_add_a_veil() -> None:
    scene = view(pose(0.0, 0.0, 280.0))
    rain = FLAWLESS.model_copy(update={"rain": RainConditions(lens_drops=40, lens_drop_mm=3.0)})
    dry = Renderer(OPTICS, ImagingParameters(), 1).picture(scene, 0).astype(np.float64)
    wet = Renderer(OPTICS, ImagingParameters(), 1, rain).picture(scene, 0).astype(np.float64)
    code = (slice(185, 295), slice(265, 375))
    assert wet[code].std() < 0.8 * dry[code].std()
    assert wet[code].min() > dry[code].min()
