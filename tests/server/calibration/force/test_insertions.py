"""When insertions begin to feel otherwise."""

from __future__ import annotations

import numpy as np
import pytest

from server.calibration.force.insertions import BAND_FROM, COMPARED, Curve, Insertions, hints_of
from server.schema.calibrations import ForceValues
from server.schema.vehicles import Vehicle

ENGAGEMENT = ((-20, 0.0), (0, 0.0), (18, 0.08), (30, 0.5), (36, 1.0), (38, 1.0), (40, 0.6))
ZOE = Vehicle(id="zoe", name="Zoe", label_payload="PP2:zoe")
SLIDE = ForceValues(
    friction_n=1.5, friction_sigma_n=0.1, offset_n=0.0, offset_sigma_n=0.1, following_mm=0.3
)


def insertion(rng: np.random.Generator, *, peak_n: float = 70.0, friction_n: float = 1.5) -> Curve:
    depths = np.arange(-18.0, 41.0, 2.0)
    share = np.interp(depths, *np.array(ENGAGEMENT).T)
    force = (peak_n + rng.normal(0.0, 1.5)) * share + friction_n + rng.normal(0.0, 0.4, len(depths))
    return tuple(zip(depths.tolist(), force.tolist(), strict=True))


def felt(
    count: int,
    *,
    rng: np.random.Generator,
    before: Insertions | None = None,
    offset_mm: tuple[float, float] = (0.0, 0.0),
    peak_n: float = 70.0,
    friction_n: float = 1.5,
) -> Insertions:
    found = before or Insertions()
    for _ in range(count):
        found = found.taken(insertion(rng, peak_n=peak_n, friction_n=friction_n), offset_mm)
    return found


def codes(found: Insertions, force: ForceValues | None = SLIDE) -> list[str]:
    return [hint.code for hint in hints_of(ZOE, found, force)]


@pytest.mark.parametrize("seed", range(6))
def test_a_plug_that_stays_as_it_is_gives_no_hint_and_a_band_around_it(seed: int) -> None:
    rng = np.random.default_rng(seed)
    found = felt(60, rng=rng)
    assert codes(found) == []
    assert codes(found, None) == []
    band = found.shown("zoe")
    assert band.learnt_from == BAND_FROM
    lower_n, upper_n = next((low, high) for depth, low, high in band.points if depth == 36)
    assert lower_n < 70 < upper_n
    assert upper_n - lower_n < 45


@pytest.mark.parametrize(
    ("peak_n", "friction_n", "code"),
    [(95.0, 1.5, "plug_heavy"), (45.0, 1.5, "plug_light"), (70.0, 9.0, "slide_heavy")],
)
def test_wear_and_dirt_are_noticed_after_some_insertions_and_forgotten_when_mended(
    peak_n: float, friction_n: float, code: str
) -> None:
    rng = np.random.default_rng(1)
    before = felt(BAND_FROM + COMPARED, rng=rng)
    one = felt(1, rng=rng, before=before, peak_n=peak_n, friction_n=friction_n)
    assert codes(one) == [], "one cold morning is no hint"
    worn = felt(COMPARED, rng=rng, before=before, peak_n=peak_n, friction_n=friction_n)
    assert code in codes(worn)
    (hint,) = [hint for hint in hints_of(ZOE, worn, None) if hint.code == code]
    assert hint.text
    assert hint.title
    assert codes(felt(COMPARED, rng=rng, before=worn)) == []


def test_a_band_does_not_creep_along_with_a_plug_that_wears() -> None:
    rng = np.random.default_rng(2)
    found = felt(BAND_FROM, rng=rng)
    for job in range(150):
        found = felt(1, rng=rng, before=found, peak_n=70.0 + 0.25 * job)
    assert codes(found) == ["plug_heavy"]


def test_a_socket_beside_its_labels_word_is_named_and_not_learnt() -> None:
    rng = np.random.default_rng(3)
    before = felt(20, rng=rng)
    knocked = felt(COMPARED, rng=rng, before=before, offset_mm=(0.8, 0.0))
    assert codes(knocked) == ["socket_off"]
    (hint,) = hints_of(ZOE, knocked, SLIDE)
    assert "+0.8 mm to the right" in hint.text
    assert hint.vehicle_id == "zoe"
    assert knocked.first == before.first
