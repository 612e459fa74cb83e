"""What this robot took before says how long it takes; interruptions say nothing."""

from __future__ import annotations

from statistics import median

import pytest
from hypothesis import given
from hypothesis import strategies as st

from server.config.phase_times import PhaseTimeSettings
from server.jobs.model import JobPhase
from server.jobs.outlook.phase_times import LATEST, PhaseTimes, TimedPhase, durations
from tests.server.jobs.outlook.journals import Entry, journal

PARKING = TimedPhase(JobPhase.PARKING)

UNPLUGGED: list[Entry] = [
    (0.0, "phase_started", JobPhase.PREFLIGHT),
    (0.5, "phase_started", JobPhase.RELEASING),
    (1.0, "released", JobPhase.RELEASING),
    (2.0, "phase_started", JobPhase.WITHDRAWING),
    (7.0, "phase_started", JobPhase.PARKING),
    (11.0, "succeeded", JobPhase.PARKING),
]


def _parking(duration_s: float) -> list[Entry]:
    return [
        (0.0, "phase_started", JobPhase.PARKING),
        (duration_s, "succeeded", JobPhase.PARKING),
    ]


def test_a_phase_lasts_until_the_next_one_begins() -> None:
    assert [(phase.phase, lasted_s) for phase, lasted_s in durations(journal(UNPLUGGED))] == [
        (JobPhase.PREFLIGHT, 0.5),
        (JobPhase.RELEASING, 1.5),
        (JobPhase.WITHDRAWING, 5.0),
        (JobPhase.PARKING, 4.0),
    ]


def test_dates_of_a_fast_simulator_are_told_in_the_robots_own_seconds() -> None:
    lasted = dict(durations(journal(UNPLUGGED, clock_speed=10.0)))
    assert lasted[PARKING] == pytest.approx(40.0)


@pytest.mark.parametrize(
    "kind", ["paused", "unpaused", "person_needed", "person_answered", "resumed"]
)
def test_an_interrupted_phase_is_not_counted(kind: str) -> None:
    entries = [
        *UNPLUGGED[:2],
        (1.5, kind, JobPhase.RELEASING),
        *((at_s + 3600.0, each, phase) for at_s, each, phase in UNPLUGGED[1:]),
    ]
    lasted = list(durations(journal(entries, phase="releasing", after_restart=True)))
    assert [phase.phase for phase, _ in lasted] == [
        JobPhase.PREFLIGHT,
        JobPhase.RELEASING,
        JobPhase.WITHDRAWING,
        JobPhase.PARKING,
    ]
    assert max(lasted_s for _, lasted_s in lasted) == pytest.approx(5.0)


def test_homing_makes_it_another_phase() -> None:
    times = PhaseTimes(PhaseTimeSettings())
    entries: list[Entry] = [
        (0.0, "phase_started", JobPhase.PREFLIGHT),
        (0.1, "homing", JobPhase.PREFLIGHT),
        (31.0, "phase_started", JobPhase.LOCATING),
    ]
    times.learn(journal(entries))
    assert times.usual_s(TimedPhase(JobPhase.PREFLIGHT, homing=True)) == 31.0
    assert times.usual_s(TimedPhase(JobPhase.PREFLIGHT)) == PhaseTimeSettings().preflight_s


@given(st.lists(st.floats(0.0, 600.0), max_size=3 * LATEST))
def test_the_median_of_the_newest_counts_and_the_settings_before_the_first(
    lasted: list[float],
) -> None:
    times = PhaseTimes(PhaseTimeSettings(parking_s=3.5))
    for duration_s in lasted:
        times.learn(journal(_parking(duration_s)))
    wanted_s = median(lasted[-LATEST:]) if lasted else 3.5
    assert times.usual_s(PARKING) == pytest.approx(wanted_s, abs=1e-5)


def test_a_clock_that_was_set_back_makes_no_negative_time() -> None:
    assert dict(durations(journal(_parking(-3600.0)))) == {PARKING: 0.0}
