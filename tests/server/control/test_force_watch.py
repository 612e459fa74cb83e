from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace

import pytest

from drivers.robot import BoardFault, FaultCode, RobotState
from server.control.errors import ForceLimitError
from server.control.faults import words_for
from server.control.force_watch import ForceWatch
from tests.support.robot_cell import RobotCell, in_cell


async def _state(cell: RobotCell) -> RobotState:
    return cell.robot


STATE = in_cell(_state)


def feed(watch: ForceWatch, forces_n: Iterable[float]) -> None:
    for force_n in forces_n:
        watch.check(replace(STATE, force_n=force_n))


def test_two_noisy_samples_mean_nothing_three_of_five_do() -> None:
    watch = ForceWatch(push_limit_n=79.0)
    feed(watch, [70, 90, 70, 90, 70, 70, 90, 70, 70])
    assert watch.largest_push_n == 70
    with pytest.raises(ForceLimitError, match="79 N") as raised:
        feed(watch, [90, 90, 90])
    assert raised.value.context == {"force_n": 90, "limit_n": 79.0}


def test_a_hard_contact_is_noticed_within_fifty_milliseconds() -> None:
    watch = ForceWatch(push_limit_n=79.0)
    feed(watch, [0.0] * 20)
    with pytest.raises(ForceLimitError):
        feed(watch, [150.0] * 3)


def test_pushing_and_pulling_have_limits_of_their_own() -> None:
    watch = ForceWatch(pull_limit_n=80.0)
    feed(watch, [200.0] * 10)
    assert (watch.largest_push_n, watch.largest_pull_n) == (200.0, 0.0)
    with pytest.raises(ForceLimitError, match="Pulling"):
        feed(watch, [-81.0] * 5)
    assert watch.largest_pull_n == 81.0


def test_without_limits_it_only_remembers() -> None:
    watch = ForceWatch()
    feed(watch, [-500.0] * 5 + [600.0] * 5)
    assert (watch.largest_push_n, watch.largest_pull_n) == (600.0, 500.0)
    assert math.isfinite(watch.largest_push_n)


@pytest.mark.parametrize("code", list(FaultCode))
def test_every_fault_has_words_that_say_what_to_do(code: FaultCode) -> None:
    words = words_for(BoardFault(code, "detail"))
    assert words.title[0].isupper()
    assert not words.title.endswith(".")
    assert words.remedy.endswith(".")
