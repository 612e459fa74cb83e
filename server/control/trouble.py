"""Why there is no link to the motion board, in words a person can act on."""

from __future__ import annotations

from dataclasses import dataclass

from drivers.robot import RobotDriverError
from server.control.errors import RobotOfflineError


@dataclass(frozen=True, slots=True)
class TroubleWords:
    """Stable code, title and remedy of a reason."""

    code: str
    title: str
    remedy: str


_UNNAMED = TroubleWords(
    RobotOfflineError.code,
    RobotOfflineError.title,
    f"{RobotOfflineError.remedy} It connects again by itself.",
)

_WORDS = (
    TroubleWords(
        "board_not_found",
        "No motion board at its port",
        "Check that the board has power, that its USB cable is in at both ends, and that the port "
        "is the right one and free: plugpilot serve --port /dev/ttyUSB0. It connects again by "
        "itself.",
    ),
    TroubleWords(
        "board_silent",
        "Nothing at the port speaks as a motion board does",
        "Check that the board has power and that the port is the board's and not that of another "
        "device. If the board is new, write its firmware: plugpilot firmware flash.",
    ),
    TroubleWords(
        "wrong_firmware",
        "The motion board has firmware of another version",
        "Stop PlugPilot, write the firmware that belongs to it: plugpilot firmware flash. Then "
        "start it again.",
    ),
    TroubleWords(
        "link_lost",
        "The link to the motion board broke",
        "Check the USB cable and the power of the board. It connects again by itself; the robot "
        "then finds its position anew.",
    ),
    TroubleWords(
        "board_refused",
        "The motion board does not take its settings",
        "Correct [robot.board] in the settings of PlugPilot, or write the firmware that belongs to "
        "this version: plugpilot firmware flash.",
    ),
)

_BY_CODE = {words.code: words for words in _WORDS}


def words_for_trouble(trouble: RobotDriverError) -> TroubleWords:
    """Code, title and remedy of what keeps the board away."""
    return _BY_CODE.get(trouble.code, _UNNAMED)
