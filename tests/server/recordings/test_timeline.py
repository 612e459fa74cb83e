"""From a recording to frames: motion in real time, waits cut down, marks where they belong."""

from __future__ import annotations

import json
from datetime import UTC, datetime
from typing import Any

import numpy as np
import pytest

from server.config.settings import Settings
from server.recordings.reader import Entry
from server.recordings.records import header_record
from server.recordings.timeline import NothingToPlayError, Timeline, timeline
from server.recordings.topics import (
    DIVERGENCE,
    EVENT,
    HEADER,
    PLAN,
    ROBOT,
    SOCKET,
    STATION,
    DivergenceRecord,
    EventRecord,
    JointsRecord,
    PlanRecord,
    PointRecord,
    RobotRecord,
    SocketRecord,
    StationRecord,
)
from server.schema.divergence import DivergenceReport
from server.schema.robot import Joints
from tests.support.jobs import job_of
from twin.divergence import Quantity
from twin.statics import SagTables

NOW = datetime(2026, 3, 1, 18, 4, 5, tzinfo=UTC)
JOB = job_of(NOW)


def with_config(config: dict[str, Any]) -> Entry:
    """The header of a recording with another configuration."""
    header = header_record(Settings(), JOB, "Simulator", NOW)
    return Entry(HEADER, 0, header.model_copy(update={"config_json": json.dumps(config)}))


class Tape:
    """A recording that is put together second by second."""

    def __init__(self) -> None:
        self.entries = [
            Entry(HEADER, 0, header_record(Settings(), JOB, "Simulator", NOW)),
        ]
        self.now_s = 0.0
        self.rho3 = 60.0

    def _put(self, topic: object, record: object) -> None:
        self.entries.append(Entry(topic, round(self.now_s * 1e9), record))  # type: ignore[arg-type]

    def robot(self) -> None:
        joints = JointsRecord(rho1=150, rho2=250, rho3=self.rho3)
        still = JointsRecord(rho1=0, rho2=0, rho3=0)
        self._put(
            ROBOT,
            RobotRecord(
                board="run",
                mode="moving",
                plug="free",
                measured_mm=joints,
                commanded_mm=joints,
                measured_mm_s=still,
                commanded_mm_s=still,
                tip=None,
                force_n=0.0,
                homed=True,
                enabled=True,
                fault=None,
            ),
        )

    def move(self, for_s: float) -> None:
        for _ in range(round(for_s / 0.01)):
            self.now_s += 0.01
            self.rho3 += 0.1
            self.robot()

    def rest(self, for_s: float) -> None:
        for _ in range(round(for_s)):
            self.now_s += 1.0
            self.robot()

    def phase(self, phase: str) -> None:
        self._put(
            EVENT,
            EventRecord(sequence=1, kind="phase_started", phase=phase, message="m", data_json="{}"),
        )

    def charging(self) -> None:
        self._put(
            STATION,
            StationRecord(
                online=True,
                pilot="C",
                enabled=True,
                held=False,
                contactor_closed=True,
                connector_locked=True,
                power_w=7000,
                currents_a=[30, 0, 0],
                session_energy_wh=10,
            ),
        )

    def socket(self) -> None:
        self._put(
            SOCKET,
            SocketRecord(
                T_base_socket=np.eye(4).ravel().tolist(),
                T_base_label=np.eye(4).ravel().tolist(),
                covariance_mm2=np.eye(3).ravel().tolist(),
                lateral_sigma_mm=0.1,
                depth_sigma_mm=0.1,
            ),
        )

    def parted(self, *, began: bool) -> None:
        report = DivergenceReport(
            quantity=Quantity.FORCE,
            title="The force",
            message="m",
            unit="N",
            expected=1,
            measured=2,
            sigma=0.1,
            sigmas=10,
            at=NOW,
            phase="inserting",
            joints=Joints(rho1_mm=1, rho2_mm=2, rho3_mm=3),
            depth_mm=None,
            tip_off_mm=None,
        )
        self._put(DIVERGENCE, DivergenceRecord(began=began, report=report, largest_difference=1.0))

    def play(self) -> Timeline:
        return timeline(self.entries, rate_hz=20, pause_s=2.0)


def test_motion_plays_in_real_time_at_the_rate() -> None:
    tape = Tape()
    tape.robot()
    tape.move(3.0)
    frames = tape.play().frames
    times = np.array([frame.at_s for frame in frames])
    assert times[-1] == pytest.approx(3.0, abs=0.06)
    assert np.diff(times) == pytest.approx(0.05)
    rho3 = [frame.state.measured.rho3_mm for frame in frames if frame.state.measured]
    assert rho3 == sorted(rho3)
    assert rho3[-1] == pytest.approx(90.0, abs=1.0)


def test_hours_of_charging_take_two_seconds_with_the_light_running() -> None:
    tape = Tape()
    tape.robot()
    tape.move(1.0)
    tape.phase("charging")
    tape.charging()
    tape.rest(7200)
    tape.phase("withdrawing")
    tape.move(1.0)
    played = tape.play()
    assert played.frames[-1].at_s == pytest.approx(4.0, abs=0.1)
    assert [mark.text for mark in played.marks] == ["charging", "withdrawing"]
    assert [mark.at_s for mark in played.marks] == pytest.approx([1.0, 3.0])
    shown = [frame.state.charging for frame in played.frames if 1.2 < frame.at_s < 2.9]
    assert len(shown) > 30
    assert all(shown)


def test_what_was_seen_and_what_has_parted_is_shown_from_then_on() -> None:
    tape = Tape()
    tape.robot()
    tape.move(1.0)
    tape.socket()
    tape.parted(began=True)
    tape.move(1.0)
    tape.parted(began=False)
    tape.move(1.0)
    played = tape.play()
    parted = [frame.at_s for frame in played.frames if frame.state.parted == ("force",)]
    assert min(parted) == pytest.approx(1.0, abs=0.06)
    assert max(parted) == pytest.approx(2.0, abs=0.06)
    seen = [frame.state.T_base_socket is not None for frame in played.frames]
    assert seen.index(True) == pytest.approx(20, abs=1)
    [mark] = played.marks
    assert (mark.kind, mark.text) == ("divergence", "The force")


def test_the_robot_is_that_of_the_recording() -> None:
    tape = Tape()
    tape.robot()
    assert tape.play().robot.geometry == Settings().geometry


def test_nothing_to_play_is_an_error() -> None:
    tape = Tape()
    with pytest.raises(NothingToPlayError):
        tape.play()
    tape.robot()
    tape.entries.pop(0)
    with pytest.raises(NothingToPlayError):
        tape.play()


def test_the_planned_way_is_shown_while_it_is_followed() -> None:
    tape = Tape()
    tape.robot()
    tips = [PointRecord(x_mm=600.0, y_mm=300.0 + i, z_mm=200.0) for i in range(3)]
    tape._put(PLAN, PlanRecord(times_s=[0.0, 0.5, 1.0], tips=tips))
    tape.move(1.0)
    tape._put(PLAN, PlanRecord(times_s=[], tips=[]))
    tape.move(1.0)
    frames = tape.play().frames
    paths = [frame.state.path for frame in frames]
    shown = [path for path in paths if path is not None]
    assert shown
    assert all(path is shown[0] for path in shown)  # the same object: drawn once
    assert shown[0].duration_s == 1.0
    assert shown[0].tips_mm[2] == pytest.approx([600, 302, 200])
    assert paths[-1] is None


def test_cable_and_sag_are_those_of_the_recorded_robot() -> None:
    header = json.loads(header_record(Settings(), JOB, "Simulator", NOW).config_json)
    header["loads"] |= {"cable_length_mm": 2000.0, "cable_mass_kg": 1.9}
    header["sag"]["alpha_x_mm"] = [500.0, 600.0, 700.0]
    tape = Tape()
    tape.entries[0] = with_config(header)
    tape.robot()
    robot = tape.play().robot
    assert (robot.loads.cable_length_mm, robot.loads.cable_mass_kg) == (2000.0, 1.9)
    assert robot.sag.alpha_x_mm == (500.0, 600.0, 700.0)


def test_a_recording_that_is_older_than_these_settings_is_played_with_the_published_ones() -> None:
    header = json.loads(header_record(Settings(), JOB, "Simulator", NOW).config_json)
    del header["loads"], header["actuators"], header["sag"]
    tape = Tape()
    tape.entries[0] = with_config(header)
    tape.robot()
    robot = tape.play().robot
    assert (robot.loads.cable_length_mm, robot.sag) == (1500.0, SagTables())
