"""Answers to commands when messages of the board are lost."""

from __future__ import annotations

import pytest

from drivers.arduino.commands import Commands
from drivers.arduino.protocol import messages
from drivers.arduino.protocol.messages import EventKind, Refusal
from drivers.arduino.words import refusal_words
from drivers.robot import BoardRefusedError, NotConnectedError

ENABLE = messages.Enable()


def refused(seq: int, why: Refusal) -> messages.Event:
    return messages.Event(EventKind.REFUSED, why, seq, 0, 0)


def status(events: int, seq: int = 0, why: Refusal = Refusal.NONE) -> messages.Ack:
    return messages.Ack(events=events, refused_seq=seq, refusal=why, stop_token=0)


async def test_what_is_acknowledged_without_a_word_was_obeyed() -> None:
    commands = Commands()
    answers = [commands.send(ENABLE) for _ in range(3)]
    assert [item.seq for item in commands.take_due(0.0)] == [0, 1, 2]
    commands.hear_ack(2, 0.01)
    assert [answer.done() for answer in answers] == [True, True, False]
    assert answers[0].exception() is None


async def test_an_event_refuses_exactly_one() -> None:
    commands = Commands()
    answers = [commands.send(ENABLE) for _ in range(3)]
    commands.take_due(0.0)
    commands.hear_event(0, refused(1, Refusal.HOMING))
    commands.hear_ack(3, 0.01)
    assert answers[0].exception() is None
    assert isinstance(answers[1].exception(), BoardRefusedError)
    assert "homing" in str(answers[1].exception())
    assert answers[2].exception() is None


async def test_a_lost_refusal_is_read_from_the_acknowledgement() -> None:
    commands = Commands()
    answers = [commands.send(ENABLE) for _ in range(2)]
    commands.take_due(0.0)
    commands.hear_status(status(1, seq=1, why=Refusal.NOT_HOMED))
    commands.hear_ack(2, 0.01)
    assert answers[0].exception() is None
    assert "homing" in str(answers[1].exception())


async def test_an_old_refusal_refuses_nothing_new() -> None:
    commands = Commands()
    first = commands.send(ENABLE)
    commands.take_due(0.0)
    commands.hear_event(0, refused(0, Refusal.HOMING))
    commands.hear_ack(1, 0.01)
    assert isinstance(first.exception(), BoardRefusedError)
    second = commands.send(ENABLE)
    commands.take_due(0.02)
    commands.hear_status(status(1, seq=0, why=Refusal.HOMING))
    commands.hear_ack(2, 0.03)
    assert second.exception() is None


async def test_when_several_events_were_lost_nobody_is_told_a_lie() -> None:
    commands = Commands()
    answers = [commands.send(ENABLE) for _ in range(3)]
    commands.take_due(0.0)
    commands.hear_status(status(2, seq=2, why=Refusal.QUEUE_FULL))
    commands.hear_ack(3, 0.01)
    assert "not known" in str(answers[0].exception())
    assert "not known" in str(answers[1].exception())
    assert "queue" in str(answers[2].exception())
    later = commands.send(ENABLE)
    commands.take_due(0.02)
    commands.hear_ack(4, 0.03)
    assert later.exception() is None


async def test_a_caller_who_gave_up_does_not_disturb_the_rest() -> None:
    commands = Commands()
    first, second = commands.send(ENABLE), commands.send(ENABLE)
    commands.take_due(0.0)
    first.cancel()
    commands.hear_ack(2, 0.01)
    assert second.exception() is None


async def test_a_broken_link_ends_all_waiting() -> None:
    commands = Commands()
    answer = commands.send(ENABLE)
    commands.fail(NotConnectedError("gone"))
    with pytest.raises(NotConnectedError, match="gone"):
        await answer


def test_every_refusal_has_words() -> None:
    words = [refusal_words(refusal) for refusal in Refusal]
    assert len(set(words)) == len(Refusal)
    assert "unknown" in refusal_words(200)
