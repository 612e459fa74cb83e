"""How a job goes on is decided from evidence alone, for every case there is."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime, timedelta

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.robot import BoardFault, FaultCode
from server.config.jobs import JobSettings
from server.control.errors import RobotStoppedError
from server.control.model import PlugState
from server.control.plug_guard import HELD
from server.jobs.errors import InsertionJammedError, JobInterruptedError
from server.jobs.history import History, history_of
from server.jobs.interruptions import JobInterruption, PersonNeeded, TurnedBack
from server.jobs.model import JobPhase, JobType
from server.jobs.recovery import SEATED, Evidence, Way, decide
from server.jobs.turning_back import WAY_BACK, Return, TurnBack
from server.schema.jobs import JobEvent, NeedsPerson
from tests.support.jobs import job_of

NOW = datetime(2026, 3, 1, 18, 0, tzinfo=UTC)
LIMITS = JobSettings()
NOTHING_YET = History(None, charging_done=False, energy_before_wh=None, resumptions={})


def evidence(
    phase: JobPhase = JobPhase.ALIGNING,
    plug: PlugState = PlugState.FREE,
    *,
    job_type: JobType = JobType.CHARGE,
    history: History = NOTHING_YET,
    **job: object,
) -> Evidence:
    return Evidence(
        job=job_of(NOW, type=job_type, phase=phase, **job),
        history=history,
        after_restart=True,
        restarted=True,
        outage=timedelta(seconds=20),
        plug=plug,
        fault=BoardFault(FaultCode.HEARTBEAT_LOST, "The host has fallen silent."),
    )


DONE = replace(NOTHING_YET, charging_done=True)
CASES = [
    (JobType.CHARGE, JobPhase.PREFLIGHT, PlugState.PARKED, NOTHING_YET, Way.PLUG_IN),
    (JobType.PLUG_IN, JobPhase.LOCATING, PlugState.FREE, NOTHING_YET, Way.PLUG_IN),
    (JobType.CHARGE, JobPhase.INSERTING, PlugState.FREE, NOTHING_YET, Way.PLUG_IN),
    (JobType.CHARGE, JobPhase.INSERTING, PlugState.INSERTED, NOTHING_YET, Way.PULL_OUT_FIRST),
    (JobType.PLUG_IN, JobPhase.INSERTING, PlugState.UNKNOWN, NOTHING_YET, Way.PULL_OUT_FIRST),
    # out again after a restart in the way in: the car has not charged yet
    (JobType.CHARGE, JobPhase.WITHDRAWING, PlugState.UNKNOWN, NOTHING_YET, Way.PULL_OUT_FIRST),
    (JobType.CHARGE, JobPhase.WITHDRAWING, PlugState.FREE, NOTHING_YET, Way.PLUG_IN),
    (JobType.PLUG_IN, JobPhase.PLUGGED, PlugState.UNKNOWN, NOTHING_YET, Way.STAY_IN),
    (JobType.CHARGE, JobPhase.CHARGING, PlugState.UNKNOWN, NOTHING_YET, Way.STAY_IN),
    (JobType.CHARGE, JobPhase.CHARGING, PlugState.INSERTED, DONE, Way.UNPLUG),
    (JobType.CHARGE, JobPhase.RELEASING, PlugState.INSERTED, DONE, Way.UNPLUG),
    (JobType.CHARGE, JobPhase.WITHDRAWING, PlugState.UNKNOWN, DONE, Way.UNPLUG),
    (JobType.CHARGE, JobPhase.WITHDRAWING, PlugState.FREE, DONE, Way.PARK),
    (JobType.CHARGE, JobPhase.PARKING, PlugState.PARKED, DONE, Way.NOTHING),
    (JobType.UNPLUG, JobPhase.PREFLIGHT, PlugState.UNKNOWN, NOTHING_YET, Way.UNPLUG),
    (JobType.UNPLUG, JobPhase.PARKING, PlugState.FREE, NOTHING_YET, Way.PARK),
]


@pytest.mark.parametrize(("job_type", "phase", "plug", "history", "way"), CASES)
def test_each_phase_goes_on_by_where_the_plug_is(
    job_type: JobType, phase: JobPhase, plug: PlugState, history: History, way: Way
) -> None:
    assert decide(evidence(phase, plug, job_type=job_type, history=history), LIMITS) is way


@given(
    st.sampled_from(JobType),
    st.sampled_from(JobPhase),
    st.sampled_from(PlugState),
    st.booleans(),
    st.sampled_from([None, *FaultCode]),
    st.booleans(),
    st.booleans(),
)
def test_no_way_begins_sideways_with_a_plug_that_may_be_in_a_socket(  # noqa: PLR0917 - a product
    job_type: JobType,
    phase: JobPhase,
    plug: PlugState,
    charging_done: bool,
    fault: FaultCode | None,
    after_restart: bool,
    cancel: bool,
) -> None:
    seen = replace(
        evidence(
            phase,
            plug,
            job_type=job_type,
            history=replace(NOTHING_YET, charging_done=charging_done),
            cancel_requested=cancel,
        ),
        fault=None if fault is None else BoardFault(fault, "It says so."),
        after_restart=after_restart,
        restarted=after_restart,
    )
    try:
        way = decide(seen, LIMITS)
    except (JobInterruption, JobInterruptedError):
        return
    if plug in HELD:
        assert way in {Way.PULL_OUT_FIRST, Way.STAY_IN, Way.UNPLUG}
    else:
        assert way in {Way.PLUG_IN, Way.PARK, Way.NOTHING}
    if way is Way.STAY_IN:
        assert phase in SEATED
    if charging_done or job_type is JobType.UNPLUG:
        assert way in {Way.UNPLUG, Way.PARK, Way.NOTHING}


def test_a_job_that_has_turned_back_never_begins_anew() -> None:
    jammed = evidence(JobPhase.INSERTING, PlugState.INSERTED).job
    turn = TurnBack.because(jammed, InsertionJammedError("It is stuck."))
    assert turn.how is Return.COME_BACK
    history = replace(NOTHING_YET, turn_back=turn)
    for phase in WAY_BACK:
        with pytest.raises(TurnedBack) as back:
            decide(evidence(phase, PlugState.UNKNOWN, history=history), LIMITS)
        assert back.value.turn == turn
        assert back.value.written


def test_a_stop_is_not_forgotten() -> None:
    job = evidence(JobPhase.INSERTING, PlugState.INSERTED).job
    turn = TurnBack.because(job, RobotStoppedError("Somebody pressed stop."))
    assert turn.how is Return.POWER_OFF
    entry = JobEvent(
        sequence=7,
        at=NOW,
        kind="turned_back",
        phase=job.phase,
        message="Somebody pressed stop.",
        data=turn.as_data(),
    )
    with pytest.raises(TurnedBack) as back:
        decide(replace(evidence(), history=history_of([entry])), LIMITS)
    assert back.value.turn.how is Return.POWER_OFF


def test_a_cancellation_that_was_asked_for_is_carried_out() -> None:
    with pytest.raises(TurnedBack) as back:
        decide(evidence(JobPhase.CHARGING, PlugState.UNKNOWN, cancel_requested=True), LIMITS)
    assert back.value.turn.cancelled
    assert not back.value.written


@pytest.mark.parametrize(
    "code", sorted(set(FaultCode) - {FaultCode.HEARTBEAT_LOST, FaultCode.QUEUE_UNDERRUN})
)
def test_a_fault_with_an_unknown_cause_needs_a_person(code: FaultCode) -> None:
    fault = BoardFault(code, "Something is wrong.")
    with pytest.raises(PersonNeeded, match="Something is wrong") as asked:
        decide(replace(evidence(), fault=fault), LIMITS)
    assert asked.value.needs.code == "robot_fault"
    # a car that charges needs no robot
    charging = replace(evidence(JobPhase.CHARGING, PlugState.UNKNOWN), fault=fault)
    assert decide(charging, LIMITS) is Way.STAY_IN


def test_the_same_phase_is_not_tried_for_ever() -> None:
    tried = {JobPhase.ALIGNING: LIMITS.max_resumptions}
    history = replace(NOTHING_YET, resumptions=tried)
    with pytest.raises(PersonNeeded, match="4 times"):
        decide(evidence(history=history), LIMITS)
    assert decide(evidence(JobPhase.LOCATING, history=history), LIMITS) is Way.PLUG_IN
    # a person who resumes it by hand is not asked again
    by_hand = replace(evidence(history=history), after_restart=False)
    assert decide(by_hand, LIMITS) is Way.PLUG_IN


def test_phases_that_take_turns_are_not_tried_for_ever_either() -> None:
    tried = {JobPhase.ALIGNING: 2, JobPhase.INSERTING: 2, JobPhase.LOCATING: 2, JobPhase.PARKING: 3}
    with pytest.raises(PersonNeeded, match="10 times"):
        decide(
            evidence(JobPhase.PREFLIGHT, history=replace(NOTHING_YET, resumptions=tried)), LIMITS
        )


def test_after_a_long_outage_nothing_goes_in_unasked() -> None:
    away = timedelta(hours=13)
    with pytest.raises(PersonNeeded, match="13 hours"):
        decide(replace(evidence(), outage=away), LIMITS)
    for phase, plug, history, way in (
        (JobPhase.CHARGING, PlugState.UNKNOWN, NOTHING_YET, Way.STAY_IN),
        (JobPhase.WITHDRAWING, PlugState.UNKNOWN, DONE, Way.UNPLUG),
    ):
        seen = replace(evidence(phase, plug, history=history), outage=away)
        assert decide(seen, LIMITS) is way


def test_a_question_stays_open_until_it_is_answered() -> None:
    needs = NeedsPerson(code="robot_fault", sentence="Look first.", choices=[])
    with pytest.raises(PersonNeeded, match="Look first"):
        decide(evidence(needs_person=needs), LIMITS)


def test_a_plug_that_a_person_has_pulled_out_ends_the_job() -> None:
    with pytest.raises(JobInterruptedError, match="somebody else has pulled it out"):
        decide(evidence(JobPhase.CHARGING, PlugState.FREE), LIMITS)
