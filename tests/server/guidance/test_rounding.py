from __future__ import annotations

from itertools import pairwise

from hypothesis import given
from hypothesis import strategies as st

from server.guidance.rounding import SteadyNumber
from server.guidance.words import distance


@given(value_mm=st.floats(4, 3000))
def test_a_number_is_within_its_step_of_the_value(value_mm: float) -> None:
    shown = SteadyNumber().show(value_mm)
    step_cm = 1 if value_mm < 200 else 5 if value_mm < 600 else 10
    assert shown >= 1
    assert abs(shown - value_mm / 10) <= step_cm / 2 + 0.6
    assert shown % step_cm == 0


@given(
    value_mm=st.floats(10, 2500),
    noise=st.lists(st.floats(-1, 1), min_size=2, max_size=40),
)
def test_noise_of_a_tenth_of_a_step_does_not_flicker(value_mm: float, noise: list[float]) -> None:
    number = SteadyNumber()
    near = abs(value_mm - 200) < 2 or abs(value_mm - 600) < 2
    shown = [number.show(value_mm + n) for n in noise]
    assert sum(a != b for a, b in pairwise(shown)) <= (1 if near else 0)


def test_it_counts_down() -> None:
    number = SteadyNumber()
    shown = [number.show(mm) for mm in range(1200, 20, -2)]
    assert shown == sorted(shown, reverse=True)
    assert len(set(shown)) > 25
    number.forget()
    assert number.show(100.0) == 10


def test_distances_are_said_as_people_say_them() -> None:
    assert (distance(8), distance(90), distance(100), distance(125)) == (
        "8 cm",
        "90 cm",
        "1.0 m",
        "1.2 m",
    )
