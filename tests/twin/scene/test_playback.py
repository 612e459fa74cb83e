"""A playback holds the scene once and then only what changes."""

from __future__ import annotations

from collections import Counter
from typing import Any

import msgspec
import numpy as np
import pytest
import zstandard

from twin.camera_mount import CameraMount
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import gamma
from twin.scene.playback import PlaybackFrame, build_playback
from twin.scene.state import TwinState
from twin.statics import ActuatorLimits, Loads, SagTables

BEGIN = JointPosition(200.0, 200.0, 60.0)


def decoded(packed: bytes) -> dict[str, Any]:
    """The library's own format: size, zstd of (size, msgpack, arrays)."""
    size = int.from_bytes(packed[:8], "little")
    raw = zstandard.ZstdDecompressor().decompress(packed[8:], max_output_size=size)
    length = int.from_bytes(raw[:8], "little")
    content: dict[str, Any] = msgspec.msgpack.decode(raw[8 : 8 + length])
    return content


def playback(frames: list[PlaybackFrame]) -> dict[str, Any]:
    packed = build_playback(
        RobotGeometry(),
        CameraMount(),
        hfov_rad=1.0,
        aspect=4 / 3,
        loads=Loads(),
        limits=ActuatorLimits(),
        sag=SagTables(),
        frames=frames,
    )
    return decoded(packed)


def moving(seconds: float) -> list[PlaybackFrame]:
    return [
        PlaybackFrame(float(t), TwinState(measured=BEGIN._replace(rho1_mm=200.0 + 10 * float(t))))
        for t in np.arange(0, seconds, 0.05)
    ]


def test_the_platform_is_where_the_robot_was() -> None:
    content = playback(moving(2.0))
    assert content["durationSeconds"] == pytest.approx(1.95)
    places = [
        (time, message["position"])
        for time, message in content["messages"]
        if message["type"] == "SetPositionMessage" and message["name"] == "/robot/platform"
    ]
    assert len(places) == pytest.approx(40, abs=2)
    time, place = places[-1]
    x_mm, y_mm = gamma.platform(RobotGeometry(), BEGIN._replace(rho1_mm=200.0 + 10 * float(time)))
    assert place[:2] == pytest.approx([x_mm / 1000, y_mm / 1000], abs=1e-6)


def test_times_never_go_back() -> None:
    times = [time for time, _ in playback(moving(1.0))["messages"]]
    assert times == sorted(times)


def test_meshes_are_sent_once_and_a_robot_at_rest_sends_nothing() -> None:
    still = TwinState(measured=BEGIN)
    content = playback([PlaybackFrame(float(t), still) for t in range(60)])
    kinds = Counter(message["type"] for _, message in content["messages"])
    names = Counter(
        message["name"] for _, message in content["messages"] if message["type"] == "GlbMessage"
    )
    assert kinds["GlbMessage"] > 10
    assert max(names.values()) == 1
    assert [time for time, _ in content["messages"] if time > 0] == []


def test_the_rings_come_and_go_with_what_has_parted() -> None:
    states = [(), ("rho2",), ("rho2", "socket"), ()]
    content = playback(
        [
            PlaybackFrame(float(second), TwinState(measured=BEGIN, parted=parted))
            for second, parted in enumerate(states)
        ]
    )
    seen = [
        (time, message["name"], message["visible"])
        for time, message in content["messages"]
        if message["type"] == "SetSceneNodeVisibilityMessage"
        and message["name"] in {"/robot/right_carriage/parted", "/car/parted"}
        and time > 0
    ]
    assert seen == [
        (1.0, "/robot/right_carriage/parted", True),
        (2.0, "/car/parted", True),
        (3.0, "/robot/right_carriage/parted", False),
        (3.0, "/car/parted", False),
    ]
