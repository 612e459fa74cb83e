from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from server.config.guidance import GuidanceSettings
from server.guidance.advice import Advice, Adviser
from server.guidance.model import CarEstimate, Direction, GuidanceState, PauseReason, Unseen
from tests.server.guidance.cars import LIMIT_RAD, MIDDLE_X_MM, REACH, SETTINGS, estimate

STEP_S = 0.1
GOOD = REACH.good
EDGE_X_MM = GOOD.rail_at(GOOD.upward.middle_mm).high_mm
REACH_EDGE_X_MM = REACH.reachable.rail_at(GOOD.upward.middle_mm).high_mm


def an_adviser(**changed: object) -> Adviser:
    guidance = GuidanceSettings.model_validate({**SETTINGS.guidance.model_dump(), **changed})
    return Adviser(REACH, guidance, LIMIT_RAD, 0.0)


def settled(adviser: Adviser, car: CarEstimate, from_s: float = 0.0) -> Advice:
    """What is said in the end about a car that stays as it is."""
    for step in range(12):
        adviser.advise(car, from_s + step * STEP_S)
    return adviser.advice


class TestStates:
    def test_a_car_in_the_best_place_stands_well(self) -> None:
        advice = settled(an_adviser(), estimate())
        assert advice.state is GuidanceState.GOOD
        assert advice.words.headline == "Stop here"
        assert advice.steps == ()
        assert advice.margin_mm is not None
        assert advice.margin_mm > 10

    def test_inside_the_reach_but_near_its_edge_is_thin(self) -> None:
        advice = settled(an_adviser(), estimate(x_mm=EDGE_X_MM + 12.0))
        assert advice.state is GuidanceState.THIN
        assert [step.direction for step in advice.steps] == [Direction.LEFT]
        assert advice.words.detail.endswith("Better: 1 cm further left.")

    def test_doubt_alone_makes_a_good_place_thin_or_worse(self) -> None:
        assert settled(an_adviser(), estimate(sigma_mm=12.0)).state is not GuidanceState.GOOD

    def test_outside_it_says_the_way_to_the_middle_in_depth(self) -> None:
        advice = settled(an_adviser(), estimate(z_mm=REACH.stop_z_mm + 52.0))
        assert advice.state is GuidanceState.MOVE
        (step,) = advice.steps
        assert (step.direction, step.shown_cm) == (Direction.FORWARD, 5)
        assert advice.words.headline == "5 cm forward"

    def test_too_far_in_it_says_back(self) -> None:
        advice = settled(an_adviser(), estimate(z_mm=REACH.stop_z_mm - 40.0))
        assert advice.words.headline == "4 cm back"

    def test_too_far_aside_it_says_to_come_in_again(self) -> None:
        advice = settled(an_adviser(), estimate(x_mm=REACH_EDGE_X_MM + 90.0))
        assert advice.state is GuidanceState.MOVE
        assert advice.steps[0].direction is Direction.LEFT
        way_mm = REACH_EDGE_X_MM + 90.0 - EDGE_X_MM
        assert advice.steps[0].distance_mm == pytest.approx(way_mm, abs=3.0)
        assert "come in again" in advice.words.remedy

    def test_a_socket_too_high_is_nothing_a_driver_can_mend(self) -> None:
        advice = settled(an_adviser(), estimate(y_mm=REACH.middle_y_mm + 260.0))
        assert advice.state is GuidanceState.MOVE
        assert advice.steps[0].direction is Direction.DOWN
        assert "too high" in advice.words.headline
        assert "mounted higher" in advice.words.remedy

    def test_from_afar_the_way_in_comes_first_and_near_by_the_side(self) -> None:
        adviser = an_adviser()
        far = estimate(x_mm=EDGE_X_MM + 80.0, z_mm=1100.0, speed_mm_s=300.0)
        assert [s.direction for s in settled(adviser, far).steps] == [
            Direction.FORWARD,
            Direction.LEFT,
        ]
        near = estimate(x_mm=EDGE_X_MM + 80.0, z_mm=350.0, speed_mm_s=50.0)
        assert settled(adviser, near, 5.0).steps[0].direction is Direction.LEFT

    def test_a_flawed_label_is_said_where_the_car_stands_well(self) -> None:
        advice = settled(an_adviser(), estimate(flawed=True))
        assert advice.state is GuidanceState.GOOD
        assert "Wipe the label" in advice.words.remedy

    @pytest.mark.parametrize("why", list(Unseen))
    def test_every_reason_without_a_car_has_words(self, why: Unseen) -> None:
        adviser = an_adviser()
        for step in range(10):
            adviser.miss(why, step * STEP_S)
        advice = adviser.advice
        assert (advice.state is GuidanceState.SEARCHING) is (why is Unseen.NOTHING)
        assert advice.words.headline
        assert advice.words.detail

    @pytest.mark.parametrize("reason", list(PauseReason))
    def test_every_pause_is_said_at_once(self, reason: PauseReason) -> None:
        adviser = an_adviser()
        settled(adviser, estimate())
        advice = adviser.pause(reason, 2.0)
        assert advice.state is GuidanceState.PAUSED
        assert advice.words.detail
        assert advice.margin_mm is None


class TestBraking:
    def test_stop_is_said_at_once_and_early_enough_to_be_obeyed(self) -> None:
        """A driver who reacts as the settings expect comes to rest in the good zone."""
        for speed in (60.0, 140.0, 300.0, 600.0):
            adviser, settings_ = an_adviser(), SETTINGS.guidance
            z = 1300.0
            while True:
                advice = adviser.advise(estimate(z_mm=z, speed_mm_s=speed), (1300.0 - z) / speed)
                if advice.state is GuidanceState.STOP:
                    break
                z -= speed * 0.02
            rest = z - speed * settings_.reaction_s - speed**2 / (2 * settings_.braking_mm_s2)
            assert rest == pytest.approx(REACH.stop_z_mm, abs=speed * 0.02 + 1.0)

    def test_who_brakes_already_is_not_told_to(self) -> None:
        car = estimate(z_mm=REACH.stop_z_mm + 150, speed_mm_s=300.0, braking_mm_s2=700.0)
        assert settled(an_adviser(), car).state is GuidanceState.MOVE
        rolling = estimate(z_mm=REACH.stop_z_mm + 150, speed_mm_s=300.0)
        assert settled(an_adviser(), rolling).state is GuidanceState.STOP

    def test_near_and_too_fast_it_says_to_slow_down(self) -> None:
        car = estimate(z_mm=REACH.stop_z_mm + 400, speed_mm_s=220.0)
        assert settled(an_adviser(), car).words.detail == "Slow down."

    def test_beyond_the_place_and_still_coming_is_stop(self) -> None:
        car = estimate(z_mm=GOOD.depth.low_mm - 5.0, speed_mm_s=30.0)
        assert settled(an_adviser(), car).state is GuidanceState.STOP

    def test_backing_out_is_never_braked(self) -> None:
        car = estimate(z_mm=REACH.stop_z_mm + 40.0, speed_mm_s=-200.0)
        assert settled(an_adviser(), car).state is GuidanceState.MOVE


class TestSkew:
    def test_it_is_claimed_only_when_sure(self) -> None:
        unsure = estimate(skew_deg=3.6, skew_sigma_deg=0.5)
        assert settled(an_adviser(), unsure).state is GuidanceState.GOOD
        sure = estimate(skew_deg=3.6, skew_sigma_deg=0.2, turned_deg=3.6)
        advice = settled(an_adviser(), sure)
        assert advice.state is GuidanceState.SKEWED
        assert "3° at most" in advice.words.detail
        assert advice.words.remedy.endswith("too far to the right.")

    def test_said_once_it_takes_a_clear_improvement_to_end(self) -> None:
        adviser = an_adviser()
        settled(adviser, estimate(skew_deg=4.0))
        advice = settled(adviser, estimate(skew_deg=2.9), 2.0)
        assert advice.state is GuidanceState.SKEWED
        assert settled(adviser, estimate(skew_deg=2.0), 4.0).state is GuidanceState.GOOD

    def test_a_car_that_stands_up_or_down_gets_no_side(self) -> None:
        advice = settled(an_adviser(), estimate(skew_deg=5.0, turned_deg=0.3))
        assert advice.state is GuidanceState.SKEWED
        assert "to the" not in advice.words.remedy

    @settings(max_examples=60, deadline=None)
    @given(true_deg=st.floats(0, 3.0), sigma_deg=st.floats(0.2, 2.0), seed=st.integers(0, 99))
    def test_a_straight_enough_car_is_hardly_ever_called_askew(
        self, true_deg: float, sigma_deg: float, seed: int
    ) -> None:
        rng = np.random.default_rng(seed)
        called = 0
        for measured in true_deg + sigma_deg * rng.standard_normal(60):
            car = estimate(skew_deg=abs(measured), skew_sigma_deg=sigma_deg)
            called += an_adviser(hold_s=0.0).advise(car, 0.0).state is GuidanceState.SKEWED
        assert called <= 4


class TestSteadiness:
    @settings(max_examples=40, deadline=None)
    @given(
        edge=st.sampled_from([EDGE_X_MM, REACH_EDGE_X_MM]),
        noise_mm=st.floats(0.0, 0.9),
        seed=st.integers(0, 999),
    )
    def test_noise_at_an_edge_changes_the_words_at_most_once(
        self, edge: float, noise_mm: float, seed: int
    ) -> None:
        rng = np.random.default_rng(seed)
        adviser, x_mm = an_adviser(), edge - SETTINGS.guidance.certainty * 0.5
        states = []
        for step in range(120):
            car = estimate(x_mm=x_mm + rng.uniform(-noise_mm, noise_mm))
            states.append(adviser.advise(car, step * STEP_S).state)
        changes = sum(a is not b for a, b in pairwise(states[4:]))
        assert changes <= 1

    def test_a_state_must_last_before_it_is_said(self) -> None:
        adviser, hold_s = an_adviser(), SETTINGS.guidance.hold_s
        settled(adviser, estimate())
        outside = estimate(z_mm=REACH.stop_z_mm + 60.0)
        assert adviser.advise(outside, 2.0).state is GuidanceState.GOOD
        assert adviser.advise(estimate(), 2.2).state is GuidanceState.GOOD
        assert adviser.advise(outside, 2.3).state is GuidanceState.GOOD, "the count began anew"
        advice = adviser.advise(outside, 2.3 + hold_s)
        assert advice.state is GuidanceState.MOVE
        assert advice.since_s == pytest.approx(2.3 + hold_s)

    def test_a_car_that_comes_into_sight_is_news_at_once(self) -> None:
        adviser = an_adviser()
        adviser.miss(Unseen.NOTHING, 0.0)
        car = estimate(z_mm=1000.0, speed_mm_s=200.0)
        assert adviser.advise(car, 0.1).state is GuidanceState.MOVE

    def test_since_is_kept_while_the_state_is(self) -> None:
        adviser = an_adviser()
        first = settled(adviser, estimate())
        assert settled(adviser, estimate(x_mm=MIDDLE_X_MM + 3), 9.0).since_s == first.since_s


@settings(max_examples=300, deadline=None)
@given(
    place=st.tuples(st.floats(300, 1000), st.floats(0, 600), st.floats(205, 1500)),
    speed_mm_s=st.sampled_from([0.0, -150.0, 20.0, 400.0]),
    skew_deg=st.floats(0, 12),
    faces_robot=st.booleans(),
)
def test_whatever_the_car_does_there_is_one_clear_word(
    place: tuple[float, float, float], speed_mm_s: float, skew_deg: float, faces_robot: bool
) -> None:
    x_mm, y_mm, z_mm = place
    adviser = an_adviser()
    car = estimate(
        x_mm,
        z_mm,
        y_mm,
        speed_mm_s=speed_mm_s,
        skew_deg=skew_deg,
        turned_deg=skew_deg,
        faces_robot=faces_robot,
    )
    advice = settled(adviser, car)
    assert advice.words.headline
    assert math.isfinite(advice.margin_mm or 0.0)
    if advice.state is GuidanceState.GOOD:
        assert speed_mm_s == 0
        assert math.radians(skew_deg) < LIMIT_RAD + 0.02
        assert (advice.margin_mm or 0.0) >= -SETTINGS.guidance.hysteresis_mm
    if advice.state is GuidanceState.MOVE:
        assert advice.steps
    sides = {step.direction for step in advice.steps}
    assert not {Direction.LEFT, Direction.RIGHT} <= sides
    assert not {Direction.FORWARD, Direction.BACK} <= sides


def test_who_backs_in_is_told_from_his_own_seat() -> None:
    def told(*, faces_robot: bool) -> set[Direction]:
        car = estimate(EDGE_X_MM + 60.0, 700.0, speed_mm_s=30.0, faces_robot=faces_robot)
        return {step.direction for step in settled(an_adviser(), car).steps}

    assert told(faces_robot=True) == {Direction.FORWARD, Direction.LEFT}
    assert told(faces_robot=False) == {Direction.BACK, Direction.RIGHT}
