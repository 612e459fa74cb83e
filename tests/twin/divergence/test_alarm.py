"""An alarm neither flickers nor cries over one noisy sample."""

from __future__ import annotations

from twin.divergence import Change, Quantity, Residual
from twin.divergence.alarm import Alarm
from twin.divergence.findings import Place
from twin.divergence.numbers import AlarmNumbers
from twin.joints import JointPosition

NUMBERS = AlarmNumbers()
JOINTS = JointPosition(1.0, 2.0, 3.0)


class Player:
    """Plays differences, in standard deviations, to an alarm: one every 10 ms."""

    def __init__(self, samples: int = NUMBERS.raise_samples) -> None:
        self.alarm = Alarm(NUMBERS, samples)
        self.now_s = 0.0

    def play(self, *sigmas: float) -> list[Change]:
        changes = []
        for each in sigmas:
            residual = Residual(Quantity.RHO3, 0.0, each, 1.0, "mm")
            changes.append(self.alarm.take(residual, self.now_s, self._place))
            self.now_s += 0.01
        return [change for change in changes if change is not None]

    def _place(self) -> Place:
        return Place(self.now_s, "", JOINTS)


def test_noise_raises_nothing_however_large() -> None:
    assert Player().play(*[9.0, 9.0, 9.0, 9.0, 0.0] * 20) == []


def test_what_lasts_raises_it_once() -> None:
    player = Player()
    [change] = player.play(*[5.0] * 30)
    assert change.began
    assert change.divergence.place.at_s == 0.04


def test_it_remembers_the_largest_difference() -> None:
    player = Player()
    player.play(*[5.0] * 6, 40.0, 5.0)
    [change] = player.play(*[0.0] * 60)
    assert not change.began
    assert change.divergence.largest.measured == 40.0
    assert change.divergence.residual.measured == 5.0


def test_it_ends_only_after_half_a_second_of_agreement() -> None:
    player = Player()
    player.play(*[5.0] * 6)
    assert player.play(*[0.0] * 45, 3.0, *[0.0] * 45) == []
    assert [change.began for change in player.play(*[0.0] * 10)] == [False]


def test_between_the_thresholds_nothing_changes() -> None:
    player = Player()
    assert player.play(*[3.5] * 200) == []
    player.play(*[5.0] * 6)
    assert player.play(*[3.5] * 200) == []


def test_one_sighting_is_enough() -> None:
    assert len(Player(samples=1).play(5.0)) == 1


def test_ending_it_says_so_once() -> None:
    player = Player()
    player.play(*[5.0] * 6)
    ended = player.alarm.end()
    assert ended is not None
    assert not ended.began
    assert player.alarm.end() is None
