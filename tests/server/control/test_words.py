"""Every fault and every reason for a missing link has words of its own."""

from __future__ import annotations

import pytest

from drivers.arduino import errors
from drivers.robot import BoardFault, BoardRefusedError, FaultCode, NotConnectedError
from server.control.errors import RobotOfflineError
from server.control.faults import words_for
from server.control.trouble import words_for_trouble


@pytest.mark.parametrize("code", FaultCode)
def test_every_fault_says_what_happened_and_what_to_do(code: FaultCode) -> None:
    words = words_for(BoardFault(code, "detail"))
    assert words.title.strip()
    assert words.remedy.endswith(".")


def test_no_two_faults_have_the_same_title() -> None:
    titles = {words_for(BoardFault(code, "")).title for code in FaultCode}
    assert len(titles) == len(FaultCode)


@pytest.mark.parametrize(
    ("error", "code"),
    [
        (errors.BoardNotFoundError("x"), "board_not_found"),
        (errors.BoardSilentError("x"), "board_silent"),
        (errors.WrongFirmwareError("x"), "wrong_firmware"),
        (errors.LinkLostError("x"), "link_lost"),
        (BoardRefusedError("x"), "board_refused"),
        (NotConnectedError("x"), RobotOfflineError.code),
    ],
)
def test_every_reason_for_a_missing_link_is_named(error: NotConnectedError, code: str) -> None:
    words = words_for_trouble(error)
    assert words.code == code
    assert words.remedy.endswith(".")


def test_the_driver_of_the_board_gives_no_reason_without_words() -> None:
    for reason in NotConnectedError.__subclasses__():
        if reason.__module__ == errors.__name__:
            assert words_for_trouble(reason("x")).code == reason.code
