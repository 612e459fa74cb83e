"""What becomes of labels."""

from __future__ import annotations

import math

import numpy as np
import pytest

from drivers.simulator.camera.conditions import Conditions, LabelConditions
from drivers.simulator.camera.imaging import ImagingParameters
from drivers.simulator.camera.label_condition import LabelCondition, drawn_condition
from drivers.simulator.camera.label_texture import LabelPainter
from drivers.simulator.camera.soil import CELLS, soil

CLEAN = LabelConditions(dirt=0.0)


@pytest.mark.parametrize("share", [0.02, 0.1, 0.4])
def test_a_cover_hides_the_share_of_the_code_that_it_is_given(share: float) -> None:
    code_share = 25 / 33
    numbers = CLEAN.model_copy(update={"covered": share})
    hidden = soil(numbers, code_share, np.random.default_rng(4))
    assert hidden is not None
    margin = round(CELLS * (1 - code_share) / 2)
    code = hidden[margin : CELLS - margin, margin : CELLS - margin]
    assert float(np.mean(code > 0.5)) == pytest.approx(share, abs=0.003)


@pytest.mark.parametrize("share", [0.004, 0.08])
def test_dirt_lies_on_about_its_share_of_the_label(share: float) -> None:
    numbers = CLEAN.model_copy(update={"dirt": share})
    shares = [
        float(np.mean(layer > 0.3))
        for seed in range(5)
        if (layer := soil(numbers, 0.75, np.random.default_rng(seed))) is not None
    ]
    assert len(shares) == 5
    assert 0.4 * share < float(np.mean(shares)) < 1.5 * share


def test_a_clean_label_has_nothing_on_it() -> None:
    assert soil(CLEAN, 0.75, np.random.default_rng(1)) is None


def test_a_bowed_label_is_met_where_the_ray_meets_it() -> None:
    """Brute force: the height of the place found lies on the ray, to a micrometre."""
    condition = LabelCondition(bow_mm=0.8, bow_angle_rad=0.3, lifted_mm=2.0, lifted_corner=(1, -1))
    camera = np.array([40.0, -30.0, -250.0])
    x, y = (part.astype(np.float32) for part in np.meshgrid(*[np.linspace(-34, 34, 9)] * 2))
    bent_x, bent_y = condition.bend(x, y, 35.0, camera)
    height = condition.height_mm(bent_x, bent_y, 35.0)
    on_ray_x = x + (camera[0] - x) * height / 250.0
    on_ray_y = y + (camera[1] - y) * height / 250.0
    assert np.abs(bent_x - on_ray_x).max() < 2e-3
    assert np.abs(bent_y - on_ray_y).max() < 2e-3
    assert float(height.max()) > 1.5


def test_heights_are_those_of_the_bow_and_of_the_corner() -> None:
    at = np.array([0.0, 30.0], dtype=np.float32)
    bowed = LabelCondition(bow_mm=0.3).height_mm(at, np.zeros_like(at), 30.0)
    assert bowed == pytest.approx([0.3, 0.0], abs=1e-6)
    corner = LabelCondition(lifted_mm=2.0, lifted_corner=(-1, 1))
    assert corner.height_mm(-at, at, 30.0) == pytest.approx([0.0, 2.0], abs=1e-6)
    assert corner.height_mm(at, -at, 30.0) == pytest.approx([0.0, 0.0])


def test_labels_are_drawn_with_the_spread_that_is_given() -> None:
    numbers, rng = LabelConditions(bow_std_mm=0.2, print_scale_std=0.003), np.random.default_rng(1)
    labels = [drawn_condition(numbers, rng) for _ in range(400)]
    assert np.std([label.bow_mm for label in labels]) == pytest.approx(0.2, rel=0.12)
    assert np.std([label.width_scale for label in labels]) == pytest.approx(0.003, rel=0.12)
    assert {label.lifted_corner for label in labels} == {(1, 1), (1, -1), (-1, 1), (-1, -1)}
    assert {label.bow_angle_rad for label in labels} == {0.0, math.pi / 2}


def test_a_label_follows_from_its_seed() -> None:
    def painted(seed: int) -> np.ndarray:
        painter = LabelPainter(ImagingParameters(), Conditions(), seed)
        return painter.texture("demo", 60.0, 6).reflectance

    assert np.array_equal(painted(5), painted(5))
    assert not np.array_equal(painted(5), painted(6))
