"""The campaign in short; ``make fuzz`` runs it at length."""

from __future__ import annotations

import random
import time

import pytest

from drivers.arduino.tracker import Tracker
from tests.campaign.fuzz.labels import Labels
from tests.campaign.fuzz.memory import MemoryWatch
from tests.campaign.fuzz.serial_line import one_session
from tests.campaign.fuzz.target import BrokenError, mutated


def test_a_board_that_lies_breaks_nothing() -> None:
    assert sum(one_session(seed) for seed in range(20)) > 100


def test_a_driver_that_trusts_the_board_would_be_found(monkeypatch: pytest.MonkeyPatch) -> None:
    def trusting(*_: object, **__: object) -> None:
        raise KeyError("a state that nobody knows")

    monkeypatch.setattr(Tracker, "take", trusting)
    with pytest.raises(BrokenError, match="seed 1"):
        one_session(1)


def test_no_label_breaks_anything() -> None:
    labels = Labels(random.Random(1))
    labels.run(time.monotonic() + 0.5)
    assert labels.tried > 20


def test_mutations_change_something_and_come_again_with_the_seed() -> None:
    data = b'{"type": "stop"}'
    many = [mutated(data, random.Random(seed)) for seed in range(200)]
    assert sum(each != data for each in many) > 190
    assert len(set(many)) > 150
    assert many == [mutated(data, random.Random(seed)) for seed in range(200)]


def test_memory_that_grows_is_told_from_memory_that_settles() -> None:
    watch = MemoryWatch.__new__(MemoryWatch)
    watch.seen_mib = [200.0, 240.0, 260.0, 270.0] + [272.0] * 30
    assert not watch.grows
    watch.seen_mib = [200.0 + 5.0 * turn for turn in range(40)]
    assert watch.grows
