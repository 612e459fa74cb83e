from __future__ import annotations

import random
from collections import deque
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.arduino.link.go_back_n import LONGEST_S, Numbered, Receiver, Sender
from drivers.arduino.protocol import messages

WINDOW = 8
RETRANSMIT_S = 0.03


def numbered(value: int) -> messages.ForceLimit:
    return messages.ForceLimit(force_dn=value)


def sender_with(count: int) -> Sender:
    sender = Sender(WINDOW, RETRANSMIT_S)
    for value in range(count):
        assert sender.offer(numbered(value)) == value
    return sender


def test_the_window_limits_what_is_under_way() -> None:
    sender = sender_with(20)
    assert [item.seq for item in sender.take_due(0.0)] == list(range(8))
    assert sender.take_due(0.001) == []
    assert sender.acknowledge(3, 0.002) == range(3)
    assert [item.seq for item in sender.take_due(0.002)] == [8, 9, 10]


def test_without_progress_everything_is_sent_again() -> None:
    sender = sender_with(3)
    sender.take_due(0.0)
    assert sender.overdue_s == pytest.approx(RETRANSMIT_S)
    sender.acknowledge(1, 0.005)
    assert sender.overdue_s == pytest.approx(0.005 + RETRANSMIT_S)
    assert [item.seq for item in sender.take_due(0.036)] == [1, 2]
    assert sender.sent_again == 2


def carry(sender: Sender, took_s: float, from_s: float, messages_carried: int) -> float:
    """One message after the other over a line that loses nothing; returns when all are there."""
    now_s = from_s
    for value in range(messages_carried):
        ticket = sender.offer(numbered(value))
        answer_s = now_s + took_s
        sender.take_due(now_s)
        while sender.overdue_s is not None and sender.overdue_s < answer_s:
            now_s = sender.overdue_s
            sender.take_due(now_s)
        now_s = answer_s
        assert sender.acknowledge((ticket + 1) % 256, now_s) == range(ticket, ticket + 1)
    return now_s


def test_on_a_slow_line_it_soon_waits_long_enough() -> None:
    sender = sender_with(0)
    now_s = carry(sender, 0.045, 0.0, 3)
    repeated = sender.sent_again
    assert repeated <= 2
    now_s = carry(sender, 0.045, now_s, 300)
    assert sender.sent_again == repeated
    carry(sender, 0.004, now_s, 50)
    sender.offer(numbered(0))
    sender.take_due(now_s + 1.0)
    assert sender.overdue_s == pytest.approx(now_s + 1.0 + RETRANSMIT_S), "no longer than needed"


def test_a_silent_line_is_asked_less_and_less_often_but_never_given_up() -> None:
    sender = sender_with(1)
    asked_s = [0.0]
    sender.take_due(0.0)
    for _ in range(6):
        assert sender.overdue_s is not None
        asked_s.append(sender.overdue_s)
        assert len(sender.take_due(sender.overdue_s)) == 1
    waits_s = [b - a for a, b in pairwise(asked_s)]
    assert waits_s == pytest.approx([0.03, 0.06, LONGEST_S, LONGEST_S, LONGEST_S, LONGEST_S])


def test_nothing_is_overdue_when_all_is_acknowledged() -> None:
    sender = sender_with(2)
    sender.take_due(0.0)
    assert sender.acknowledge(2, 0.01) == range(2)
    assert sender.overdue_s is None
    assert sender.take_due(10.0) == []


@pytest.mark.parametrize("ack", [0, 4, 100, 255])
def test_an_acknowledgement_of_what_was_never_sent_is_ignored(ack: int) -> None:
    sender = sender_with(3)
    sender.take_due(0.0)
    assert sender.acknowledge(ack, 0.01) == range(0)
    assert sender.acknowledged == 0


def test_a_window_that_makes_numbers_ambiguous_is_refused() -> None:
    with pytest.raises(ValueError, match="window"):
        Sender(128, RETRANSMIT_S)


class LossyLine:
    """Loses, doubles, delays and reorders what it carries, all at random."""

    def __init__(self, rng: random.Random, loss: float, doubling: float, reach: int) -> None:
        self._rng = rng
        self._loss = loss
        self._doubling = doubling
        self._reach = reach
        self._content: deque[object] = deque()

    @property
    def is_empty(self) -> bool:
        return not self._content

    def put(self, item: object) -> None:
        if self._rng.random() < self._loss:
            return
        for _ in range(2 if self._rng.random() < self._doubling else 1):
            # overtakes at most `reach` others
            place = max(len(self._content) - self._rng.randint(0, self._reach), 0)
            self._content.insert(place, item)

    def take(self) -> object | None:
        return self._content.popleft() if self._content and self._rng.random() < 0.7 else None


@given(
    seed=st.integers(0, 2**32),
    count=st.integers(1, 600),
    loss=st.floats(0, 0.3),
    doubling=st.floats(0, 0.3),
    reach=st.integers(0, 5),
)
def test_everything_arrives_once_and_in_order(
    seed: int, count: int, loss: float, doubling: float, reach: int
) -> None:
    rng = random.Random(seed)
    there, back = (LossyLine(rng, loss, doubling, reach) for _ in range(2))
    sender, receiver = sender_with(count), Receiver()
    arrived: list[int] = []
    confirmed: list[int] = []
    now_s = 0.0
    while len(confirmed) < count:
        now_s += 0.002
        if there.is_empty and back.is_empty and sender.overdue_s is not None:
            now_s = max(now_s, sender.overdue_s)
        assert now_s < 1000, "it has got stuck"
        for item in sender.take_due(now_s):
            there.put(item)
        for _ in range(4):
            got = there.take()
            if isinstance(got, Numbered):
                if receiver.accept(got.seq):
                    assert isinstance(got.message, messages.ForceLimit)
                    arrived.append(got.message.force_dn)
                back.put(receiver.expected)
            ack = back.take()
            if isinstance(ack, int):
                confirmed += sender.acknowledge(ack, now_s)
                assert len(confirmed) <= len(arrived), "confirmed before it arrived"
    assert arrived == list(range(count))
    assert confirmed == list(range(count))
