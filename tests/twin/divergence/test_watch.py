"""The model beside the robot: alarms begin where they should, and in the right words."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from pydantic import ValidationError

from tests.support.slide_drive import MASSES_N_S2_MM
from tests.twin.divergence.samples import START, real_drive, sample, slide_in
from twin.divergence import (
    Change,
    DivergenceNumbers,
    DivergenceWatch,
    Entry,
    Quantity,
    Sighting,
)
from twin.divergence.numbers import AlarmNumbers, ForceNumbers
from twin.divergence.words import sentence, title
from twin.geometry import RobotGeometry

COARSE = DivergenceNumbers(force=ForceNumbers(noise_n=4.3))
"""A count more or less of the encoder in 16 ms, by which the board's loop works, is 8.6 N."""


def watch() -> DivergenceWatch:
    return DivergenceWatch(RobotGeometry(), DivergenceNumbers())


def test_a_good_robot_raises_nothing() -> None:
    model = watch()
    assert [model.take_sample(each) for each in slide_in()] == [[]] * len(list(slide_in()))


def test_a_jam_names_the_slide_and_where_it_stands() -> None:
    model = watch()
    model.begin_phase("inserting", 0.0)
    model.entry = Entry(face_rho3_mm=75.0, sigma_mm=0.02)
    changes: list[Change] = []
    for each in slide_in(stuck_at_mm=80.0, force_n=lambda x: 79.0 if x >= 80.0 else 1.5):
        changes += model.take_sample(each)
    found = {change.divergence.quantity: change.divergence for change in changes}
    slide, force = found[Quantity.RHO3], found[Quantity.FORCE]
    assert slide.place.phase == "inserting"
    assert slide.place.depth_mm == pytest.approx(5.0, abs=0.05)
    assert slide.place.tip_off_mm == pytest.approx(abs(slide.residual.difference), rel=0.01)
    assert "The slide is at 80.00 mm instead of" in sentence(slide)
    assert "Pushing the plug 5.0 mm deep takes 79 N" in sentence(force)
    assert {each.quantity for each in model.parted} >= {Quantity.RHO3, Quantity.FORCE}


def forces_found(load_n: Callable[[float], float], mass_n_s2_mm: float) -> list[Change]:
    """What is said about the force of a slide that a real drive moves."""
    model = DivergenceWatch(RobotGeometry(), COARSE)
    drive = real_drive(load_n, mass_n_s2_mm)
    changes = [change for each in drive for change in model.take_sample(each)]
    return [each for each in changes if each.divergence.quantity is Quantity.FORCE]


@pytest.mark.parametrize("mass_n_s2_mm", MASSES_N_S2_MM)
def test_what_turns_the_rotor_is_no_force_on_the_plug(mass_n_s2_mm: float) -> None:
    assert forces_found(lambda _: 1.5, mass_n_s2_mm) == []
    [met] = forces_found(lambda way_mm: 30.0 if way_mm > 10.0 else 1.5, mass_n_s2_mm)
    assert 70.0 < met.divergence.place.joints.rho3_mm < 72.0


def test_while_the_robot_homes_or_brakes_nothing_is_compared() -> None:
    model = watch()
    off = START._replace(rho3_mm=90.0)
    for step in range(100):
        assert model.take_sample(sample(step * 0.01, measured=off, following=False)) == []


def test_a_force_at_an_unknown_place_says_nothing() -> None:
    model = watch()
    for each in slide_in(force_n=lambda _: 50.0):
        known = sample(
            each.at_s,
            measured=each.measured,
            commanded=each.commanded,
            velocity=each.velocity,
            force_n=each.force_n,
            contact_known=False,
        )
        assert model.take_sample(known) == []


def test_a_phase_that_takes_too_long_is_named_and_forgotten_with_its_end() -> None:
    model = watch()
    model.begin_phase("withdrawing", 0.0)
    changes = [change for step in range(250) for change in model.take_sample(sample(step * 0.01))]
    [begun] = changes
    assert "The step withdrawing has taken 1." in sentence(begun.divergence)
    [ended] = model.begin_phase("parking", 2.5)
    assert not ended.began
    assert model.parted == ()


def test_charging_may_take_as_long_as_it_likes() -> None:
    model = watch()
    model.begin_phase("charging", 0.0)
    assert all(model.take_sample(sample(float(step))) == [] for step in range(100))


def test_a_socket_that_seems_to_move_is_told_at_once_and_ends_with_the_job() -> None:
    model = watch()
    place, sure = np.array([600.0, 340.0, 235.0]), np.eye(3) * 1e-4
    assert model.take_sighting(Sighting(1.0, place, sure, START)) == []
    [change] = model.take_sighting(Sighting(2.0, place + np.array([0.7, 0, 0]), sure, START))
    assert "0.70 mm from where it was first seen" in sentence(change.divergence)
    assert [each.began for each in model.begin_job()] == [False]


def test_a_fast_simulation_gets_more_time_for_what_is_computed() -> None:
    numbers = DivergenceNumbers()
    fast, slow = numbers.for_clock(20.0), numbers.for_clock(0.5)
    usual = numbers.time.phases["aligning"]
    assert fast.time.phases["aligning"].sigma_s == 20 * usual.sigma_s
    assert fast.tracking == numbers.tracking
    assert slow == numbers


def test_every_quantity_has_a_title() -> None:
    titles = [title(quantity) for quantity in Quantity]
    assert len(set(titles)) == len(Quantity)


def test_an_alarm_must_end_below_where_it_begins() -> None:
    with pytest.raises(ValidationError, match="clear_sigmas must be below"):
        AlarmNumbers(raise_sigmas=3, clear_sigmas=3)
