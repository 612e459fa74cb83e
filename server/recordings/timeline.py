"""From the messages of a recording to the frames of its 3D playback."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Literal, cast

import numpy as np

from drivers.camera import CameraModel
from drivers.station import PilotState
from server.config.forces import loads_at_limits
from server.config.insertion import InsertionSettings
from server.recordings.reader import Entry
from server.recordings.topics import (
    DivergenceRecord,
    EventRecord,
    HeaderRecord,
    JointsRecord,
    PlanRecord,
    RobotRecord,
    SocketRecord,
    StationRecord,
)
from server.schema.jobs import PlaybackMark
from twin.camera_mount import CameraMount
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.scene.playback import PlaybackFrame
from twin.scene.state import PlannedPath, PlugPlace, TwinState
from twin.statics import ActuatorLimits, Loads, SagTables

CHARGING = {PilotState.C.value, PilotState.D.value}

LONGEST_GAP_S = 5.0
"""Samples come every second even at rest: in a longer gap PlugPilot was not running."""

STILL_MM = 0.02
"""Joints that have moved less between two samples stand still."""


class NothingToPlayError(ValueError):
    """The recording does not say what robot it is about, or nothing of its motion."""


@dataclass(frozen=True, slots=True)
class RecordedRobot:
    """What the header of a recording says about the robot."""

    geometry: RobotGeometry
    mount: CameraMount
    optics: CameraModel
    loads: Loads
    limits: ActuatorLimits
    sag: SagTables


@dataclass(frozen=True, slots=True)
class Timeline:
    """A recording as it is played back.

    Attributes:
        robot: What it is about.
        frames: In the order of time.
        marks: Beginnings of phases and divergences.
    """

    robot: RecordedRobot
    frames: list[PlaybackFrame]
    marks: list[PlaybackMark]


def timeline(entries: Iterable[Entry], *, rate_hz: float, pause_s: float) -> Timeline:
    """Lay a recording out in time.

    Waits without motion are cut down, so that hours of charging do not hide a minute of motion.

    Args:
        entries: The recording.
        rate_hz: Frames per second.
        pause_s: Longer waits are cut down to this.

    Raises:
        NothingToPlayError: there is no header or no motion in it.
    """
    reel = _Reel(rate_hz, pause_s)
    robot: RecordedRobot | None = None
    for entry in sorted(entries, key=lambda entry: entry.log_time_ns):
        record, at_s = entry.record, entry.log_time_ns / 1e9
        match record:
            case HeaderRecord():
                robot = _robot(record)
            case RobotRecord():
                reel.move(record, at_s)
            case PlanRecord():
                reel.plan(record)
            case SocketRecord():
                reel.see(record)
            case StationRecord():
                reel.change(charging=record.pilot in CHARGING)
            case EventRecord(kind="phase_started"):
                reel.mark("phase", record.phase)
            case DivergenceRecord():
                reel.part(record)
            case _:
                pass
    if robot is None or not reel.frames:
        raise NothingToPlayError("the recording holds no header or no motion")
    return Timeline(robot, reel.frames, reel.marks)


class _Reel:
    """Frames and marks so far, and the clock of the playback."""

    def __init__(self, rate_hz: float, pause_s: float) -> None:
        self.frames: list[PlaybackFrame] = []
        self.marks: list[PlaybackMark] = []
        self._step_s = 1 / rate_hz
        self._pause_s = pause_s
        self._state = TwinState()
        self._now_s = 0.0
        self._rested_s = 0.0
        self._last_at_s: float | None = None
        self._parted: dict[str, None] = {}

    def move(self, record: RobotRecord, at_s: float) -> None:
        measured = _position(record.measured_mm) if record.homed else None
        self._advance(at_s, resting=self._is_resting(measured))
        self._state = replace(
            self._state,
            measured=measured,
            commanded=_position(record.commanded_mm) if record.homed else None,
            force_n=record.force_n,
            plug=cast("PlugPlace", record.plug),
            mode=record.mode,
        )
        if not self.frames:
            self.frames.append(PlaybackFrame(0.0, self._state))

    def plan(self, record: PlanRecord) -> None:
        path = None
        if record.times_s:
            tips_mm = np.array([(tip.x_mm, tip.y_mm, tip.z_mm) for tip in record.tips])
            path = PlannedPath(np.array(record.times_s), tips_mm)
        self._state = replace(self._state, path=path)

    def see(self, record: SocketRecord) -> None:
        self._state = replace(
            self._state,
            T_base_socket=np.array(record.T_base_socket).reshape(4, 4),
            T_base_label=np.array(record.T_base_label).reshape(4, 4),
            socket_covariance_mm2=np.array(record.covariance_mm2).reshape(3, 3),
        )

    def change(self, *, charging: bool) -> None:
        self._state = replace(self._state, charging=charging)

    def part(self, record: DivergenceRecord) -> None:
        quantity = record.report.quantity.value
        if record.began:
            self._parted[quantity] = None
            self.mark("divergence", record.report.title)
        else:
            self._parted.pop(quantity, None)
        self._state = replace(self._state, parted=tuple(self._parted))

    def mark(self, kind: Literal["phase", "divergence"], text: str) -> None:
        self.marks.append(PlaybackMark(at_s=round(self._now_s, 2), kind=kind, text=text))

    def _is_resting(self, measured: JointPosition | None) -> bool:
        before = self._state.measured
        if measured is None or before is None:
            return measured is before
        return max(abs(a - b) for a, b in zip(measured, before, strict=True)) < STILL_MM

    def _advance(self, at_s: float, *, resting: bool) -> None:
        """Let the playback go on until a sample, showing what was known before it."""
        passed_s = 0.0 if self._last_at_s is None else at_s - self._last_at_s
        if passed_s > LONGEST_GAP_S:
            passed_s = self._pause_s
        self._last_at_s = at_s
        if resting:
            left_s = max(self._pause_s - self._rested_s, 0.0)
            self._rested_s += passed_s
            passed_s = min(passed_s, left_s)
        else:
            self._rested_s = 0.0
        end_s = self._now_s + passed_s
        while self.frames and self.frames[-1].at_s + self._step_s <= end_s:
            next_s = self.frames[-1].at_s + self._step_s
            self.frames.append(PlaybackFrame(next_s, self._state))
        self._now_s = end_s


def _robot(header: HeaderRecord) -> RecordedRobot:
    config = json.loads(header.config_json)
    return RecordedRobot(
        RobotGeometry.model_validate(config["geometry"]),
        CameraMount.model_validate(config["camera"]["mount"]),
        CameraModel.model_validate(config["camera"]["optics"]),
        # What older recordings do not say was so.
        loads_at_limits(
            Loads.model_validate(config.get("loads", {})),
            InsertionSettings.model_validate(config["insertion"]),
        ),
        ActuatorLimits.model_validate(config.get("actuators", {})),
        SagTables.model_validate(config.get("sag", {})),
    )


def _position(joints: JointsRecord) -> JointPosition:
    return JointPosition(joints.rho1, joints.rho2, joints.rho3)
