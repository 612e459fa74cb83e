"""What can be told of a job, and what cannot."""

from __future__ import annotations

from dataclasses import replace
from datetime import datetime, timedelta
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from server.config.phase_times import PhaseTimeSettings
from server.control.model import PlugState
from server.jobs.model import JobPhase, JobState, JobType, Milestone
from server.jobs.outlook.milestones import WAY_IN, WAY_OUT, Charge, Sight, outlook
from server.jobs.outlook.phase_times import PhaseTimes
from server.jobs.outlook.progress import Progress, Stage
from server.jobs.turning_back import Return
from server.schema.jobs import NeedsPerson
from tests.server.jobs.outlook.journals import BEGAN
from tests.support.jobs import job_of

TIMES = PhaseTimes(
    PhaseTimeSettings(
        preflight_s=1.0,
        preflight_with_homing_s=20.0,
        locating_s=2.0,
        aligning_s=3.0,
        inserting_s=5.0,
        releasing_s=2.0,
        withdrawing_s=4.0,
        parking_s=6.0,
    )
)
LEAD = timedelta(seconds=90)


def _at(seconds: float) -> datetime:
    return BEGAN + timedelta(seconds=seconds)


def _sight(
    phase: JobPhase | None,
    job_type: JobType = JobType.CHARGE,
    *,
    now_s: float = 0.0,
    plug: PlugState = PlugState.PARKED,
    **job: Any,  # noqa: ANN401 - fields of a job
) -> Sight:
    """A job whose phase has begun at the beginning of all times."""
    return Sight(
        job=job_of(BEGAN, type=job_type, phase=phase or JobPhase.PREFLIGHT, **job),
        progress=Progress(Stage(phase, BEGAN) if phase is not None else None),
        plug=plug,
        homed=True,
        charge=Charge(None, None, LEAD),
        now=_at(now_s),
        clock_speed=1.0,
    )


def _told(seen: Sight) -> tuple[Milestone, float] | None:
    """Milestone, and seconds from the beginning of the phase."""
    found = outlook(seen, TIMES)
    return None if found is None else (found.milestone, (found.at - BEGAN).total_seconds())


@pytest.mark.parametrize(
    ("phase", "wanted"),
    [
        (JobPhase.PREFLIGHT, (Milestone.PLUGGED, 11.0)),
        (JobPhase.LOCATING, (Milestone.PLUGGED, 10.0)),
        (JobPhase.ALIGNING, (Milestone.PLUGGED, 8.0)),
        (JobPhase.INSERTING, (Milestone.PLUGGED, 5.0)),
        (JobPhase.PLUGGED, None),
        (JobPhase.CHARGING, None),
    ],
)
@pytest.mark.parametrize("job_type", [JobType.CHARGE, JobType.PLUG_IN])
def test_on_the_way_in_the_phases_to_come_are_added_up(
    job_type: JobType, phase: JobPhase, wanted: object
) -> None:
    assert _told(_sight(phase, job_type)) == wanted


@pytest.mark.parametrize(
    ("phase", "wanted_s"),
    [(JobPhase.RELEASING, 12.0), (JobPhase.WITHDRAWING, 10.0), (JobPhase.PARKING, 6.0)],
)
def test_on_the_way_out_too(phase: JobPhase, wanted_s: float) -> None:
    assert _told(_sight(phase, JobType.UNPLUG)) == (Milestone.UNPLUGGED, wanted_s)
    charged = _sight(phase)
    charged = replace(charged, progress=replace(charged.progress, charging_done=True))
    assert _told(charged) == (Milestone.UNPLUGGED, wanted_s)


def test_an_unplugging_gets_ready_without_homing() -> None:
    seen = _sight(JobPhase.PREFLIGHT, JobType.UNPLUG, plug=PlugState.INSERTED)
    assert _told(replace(seen, homed=False)) == (Milestone.UNPLUGGED, 13.0)


def test_a_robot_that_must_find_itself_first_takes_longer_until_the_phase_ends() -> None:
    seen = replace(_sight(JobPhase.PREFLIGHT), homed=False)
    assert _told(seen) == (Milestone.PLUGGED, 30.0)
    stage = Stage(JobPhase.PREFLIGHT, BEGAN, homing=True)
    assert _told(replace(seen, homed=True, progress=Progress(stage))) == (Milestone.PLUGGED, 30.0)


def test_a_free_plug_goes_to_the_parking_place_first() -> None:
    seen = _sight(JobPhase.PREFLIGHT, plug=PlugState.FREE)
    assert _told(seen) == (Milestone.PLUGGED, 17.0)


def test_a_plug_that_was_half_in_comes_out_and_goes_in_again() -> None:
    for job_type in (JobType.CHARGE, JobType.PLUG_IN):
        seen = _sight(JobPhase.WITHDRAWING, job_type, plug=PlugState.INSERTED)
        assert _told(seen) == (Milestone.PLUGGED, 4.0 + 6.0 + 11.0)


@given(
    phase=st.sampled_from([*WAY_IN, *WAY_OUT]),
    job_type=st.sampled_from(list(JobType)),
    now_s=st.floats(0.0, 1000.0),
    speed=st.sampled_from([1.0, 10.0]),
)
def test_it_is_never_over_and_what_comes_after_an_overdue_phase_still_counts(
    phase: JobPhase, job_type: JobType, now_s: float, speed: float
) -> None:
    early = outlook(replace(_sight(phase, job_type), clock_speed=speed), TIMES)
    seen = replace(_sight(phase, job_type, now_s=now_s), clock_speed=speed)
    found = outlook(seen, TIMES)
    assert found is not None
    assert early is not None
    assert found.at >= max(seen.now, early.at)
    overdue = replace(seen, progress=Progress(Stage(phase, BEGAN - timedelta(days=1))))
    late = outlook(overdue, TIMES)
    assert late is not None
    assert timedelta() <= late.at - seen.now < early.at - BEGAN


def test_a_fast_simulator_is_told_by_its_dates() -> None:
    seen = replace(_sight(JobPhase.ALIGNING), clock_speed=10.0)
    assert _told(seen) == (Milestone.PLUGGED, 0.8)


def _charging(power_w: float | None, left_wh: float | None, unplug_s: float | None = None) -> Sight:
    unplug_by = None if unplug_s is None else _at(unplug_s)
    seen = _sight(JobPhase.CHARGING, plug=PlugState.INSERTED, now_s=60.0, unplug_by=unplug_by)
    return replace(seen, charge=Charge(left_wh, power_w, LEAD))


@pytest.mark.parametrize(
    ("power_w", "left_wh", "unplug_s", "at_s", "latest"),
    [
        (7200.0, 3600.0, None, 60.0 + 1800.0, False),
        (7200.0, 3600.0, 7200.0, 60.0 + 1800.0, False),
        (7200.0, 3600.0, 1200.0, 1110.0, True),
        (None, 3600.0, 7200.0, 7110.0, True),
        (7200.0, None, 7200.0, 7110.0, True),
        (7200.0, -1.0, None, 60.0, False),
        (7200.0, None, 100.0, 60.0, True),
    ],
)
def test_charging_ends_by_the_energy_or_by_the_clock(
    power_w: float | None, left_wh: float | None, unplug_s: float | None, at_s: float, latest: bool
) -> None:
    found = outlook(_charging(power_w, left_wh, unplug_s), TIMES)
    assert found is not None
    assert found.milestone is Milestone.CHARGED
    assert found.latest is latest
    assert (found.at - BEGAN).total_seconds() == pytest.approx(at_s)


def test_without_either_nothing_can_be_told_of_it() -> None:
    assert _told(_charging(7200.0, None)) is None
    assert _told(_charging(None, 3600.0)) is None


NEEDS = NeedsPerson(code="robot_fault", sentence="Look.", choices=[])


@pytest.mark.parametrize(
    "changes", [{"paused": True}, {"needs_person": NEEDS}, {"state": JobState.QUEUED}]
)
def test_nothing_is_told_of_a_job_that_does_not_go_on(changes: dict[str, Any]) -> None:
    assert _told(_sight(JobPhase.ALIGNING, **changes)) is None


def test_nor_of_one_whose_next_phase_is_not_known_yet() -> None:
    assert _told(_sight(None)) is None


@pytest.mark.parametrize(
    ("how", "plug", "wanted"),
    [
        (Return.COME_BACK, PlugState.INSERTED, (Milestone.UNPLUGGED, 42.0)),
        (Return.COME_BACK, PlugState.FREE, (Milestone.UNPLUGGED, 36.0)),
        (Return.COME_BACK, PlugState.PARKED, None),
        (Return.STAY, PlugState.FREE, None),
        (Return.POWER_OFF, PlugState.INSERTED, None),
    ],
)
def test_a_job_that_turns_back_leads_home_if_it_moves_at_all(
    how: Return, plug: PlugState, wanted: object
) -> None:
    seen = replace(_sight(None, now_s=30.0, plug=plug), progress=Progress(None, turned=how))
    assert _told(seen) == wanted


def test_a_cancelled_job_turns_back_while_it_still_comes_to_rest() -> None:
    seen = _sight(JobPhase.ALIGNING, now_s=1.0, plug=PlugState.FREE, cancel_requested=True)
    assert _told(seen) == (Milestone.UNPLUGGED, 7.0)
    given_up = _sight(JobPhase.RELEASING, JobType.UNPLUG, cancel_requested=True)
    assert _told(replace(given_up, plug=PlugState.INSERTED)) is None
