from __future__ import annotations

import math

import numpy as np
import pytest

from server.guidance.track import LEAN_SIGMA, CarTrack
from tests.server.guidance.cars import SETTINGS, sighting

START = np.array([650.0, 260.0, 1100.0])
PERIOD_S = 0.1


def follow(
    speed_mm_s: float, seconds: float, *, sigma_mm: float = 0.5, seed: int = 1
) -> tuple[CarTrack, np.ndarray]:
    """A track of a car at a constant speed, and where it really is at the end."""
    rng = np.random.default_rng(seed)
    velocity = np.array([0.0, 0.0, -speed_mm_s])
    track = None
    for t_s in np.arange(0.0, seconds, PERIOD_S).tolist():
        truth = START + velocity * t_s
        seen = sighting(t_s, truth + rng.normal(0, sigma_mm, 3), sigma_mm=sigma_mm)
        if track is None:
            track = CarTrack(seen, SETTINGS.guidance)
        else:
            track.take(seen)
    assert track is not None
    return track, truth


def test_it_finds_the_speed_and_predicts() -> None:
    track, truth = follow(300.0, 3.0)
    car = track.estimate
    assert car.approach_mm_s == pytest.approx(300.0, abs=25.0)
    assert car.place_mm == pytest.approx(truth, abs=2.0)
    later = track.place_at(car.at_s + 0.5)
    assert later[2] == pytest.approx(truth[2] - 150.0, abs=15.0)
    assert not car.still
    assert track.travelled_mm == pytest.approx(300.0 * 2.9, abs=30.0)


def test_the_covariance_is_honest() -> None:
    """95% of the errors that pictures make inside 95% of what is said, over many cars."""
    inside = 0
    for seed in range(150):
        track, truth = follow(120.0, 1.5, sigma_mm=1.0, seed=seed)
        car = track.estimate
        error = car.place_mm - truth
        inside += float(error @ np.linalg.solve(car.covariance_mm2, error)) < 7.81
    assert inside >= 142
    far = CarTrack(sighting(0.0, START), SETTINGS.guidance).estimate
    assert math.sqrt(far.covariance_mm2[2, 2]) > 0.002 * 1100, "a wrong scale does not average out"


def test_standing_needs_time() -> None:
    settings = SETTINGS.guidance
    track = CarTrack(sighting(0.0, START), settings)
    stood = []
    for step in range(1, 15):
        track.take(sighting(step * PERIOD_S, START + np.array([0.2 * (step % 2), 0, 0])))
        stood.append(track.still)
    first = (1 + stood.index(True)) * PERIOD_S
    assert first == pytest.approx(settings.still_s, abs=1.5 * PERIOD_S)
    assert all(stood[stood.index(True) :])
    track.take(sighting(1.5, START - np.array([0, 0, settings.still_mm + 2.0])))
    assert not track.still


def test_a_slow_creep_is_no_standing() -> None:
    track, _ = follow(15.0, 4.0, sigma_mm=0.05)
    assert not track.estimate.still


def test_looks_that_come_seldom_still_tell_standing() -> None:
    track = CarTrack(sighting(0.0, START), SETTINGS.guidance)
    for t_s in (1.0, 2.0):
        track.take(sighting(t_s, START))
    assert track.still


def test_another_motion_begins_a_new_track() -> None:
    track, _ = follow(0.0, 2.0)
    elsewhere = START + np.array([400.0, 0.0, 0.0])
    track.take(sighting(2.0, elsewhere))
    assert track.estimate.place_mm == pytest.approx(elsewhere)
    assert not track.still


def test_an_old_sighting_changes_nothing() -> None:
    track, _ = follow(200.0, 1.0)
    before = track.estimate.place_mm
    track.take(sighting(0.3, START))
    assert np.array_equal(track.estimate.place_mm, before)


def test_braking_is_noticed() -> None:
    track = CarTrack(sighting(0.0, START), SETTINGS.guidance)
    z, v = START[2], 500.0
    for step in range(1, 12):
        track.take(sighting(step * PERIOD_S, np.array([650.0, 260.0, z])))
        z, v = z - v * PERIOD_S, v - (0.0 if step < 5 else 60.0)
    assert track.estimate.braking_mm_s2 == pytest.approx(600.0, rel=0.3)


def test_the_skew_of_a_standing_car_averages_but_not_below_the_floor() -> None:
    rng = np.random.default_rng(3)
    track = CarTrack(sighting(0.0, START, lean=(0.07, 0.0), lean_sigma_rad=0.02), SETTINGS.guidance)
    moving = track.estimate
    for step in range(1, 12):
        lean = tuple((np.array([0.07, 0.0]) + rng.normal(0, 0.02, 2)).tolist())
        track.take(sighting(step * PERIOD_S, START, lean=lean, lean_sigma_rad=0.02))
    car = track.estimate
    assert car.still
    assert LEAN_SIGMA < car.skew_sigma_rad < 0.6 * moving.skew_sigma_rad
    assert car.skew_rad == pytest.approx(0.07, abs=3 * car.skew_sigma_rad)
    assert car.turned_rad == pytest.approx(-0.07, abs=3 * car.skew_sigma_rad)


@pytest.mark.parametrize("faces_robot", [True, False])
def test_a_vehicle_of_its_own_way_is_not_asked_the_settings(faces_robot: bool) -> None:
    other = SETTINGS.guidance.model_copy(
        update={"driver_faces": "away" if faces_robot else "robot"}
    )
    assert CarTrack(sighting(0.0, START), other).estimate.faces_robot is not faces_robot
    own = sighting(0.0, START, faces_robot=faces_robot)
    assert CarTrack(own, other).estimate.faces_robot is faces_robot
