"""Finding values in a JSON answer by paths such as data.phases[0].current."""

from __future__ import annotations

import math
import re

from pydantic import JsonValue

from drivers.station.errors import StationAnswerError

_STEP = re.compile(r"[^.\[\]]+|\[\d+\]")


class Places:
    """The values of one answer.

    Args:
        name: Name of the station, for messages.
        answer: The whole answer.
    """

    def __init__(self, name: str, answer: JsonValue) -> None:
        self._name = name
        self._answer = answer

    def value(self, path: str) -> JsonValue:
        """What is there.

        Raises:
            StationAnswerError: nothing is.
        """
        value = self._answer
        for step in _STEP.findall(path):
            try:
                if step.startswith("["):
                    value = value[int(step[1:-1])] if isinstance(value, list) else _none()
                else:
                    value = value[step] if isinstance(value, dict) else _none()
            except LookupError:
                raise self._wrong(path, "is not there") from None
        return value

    def number(self, path: str) -> float:
        """A finite number.

        Raises:
            StationAnswerError: it is none.
        """
        value = self.value(path)
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise self._wrong(path, f"is no number ({value!r:.40})")
        if abs(value) > 1e12 or math.isnan(value):
            raise self._wrong(path, f"is no possible number ({value!r:.40})")
        return float(value)

    def truth(self, path: str) -> bool:
        """True or false, or 1 or 0.

        Raises:
            StationAnswerError: it is neither.
        """
        value = self.value(path)
        if isinstance(value, bool):
            return value
        if isinstance(value, int) and value in {0, 1}:
            return bool(value)
        raise self._wrong(path, f"is neither true nor false ({value!r:.40})")

    def text(self, path: str) -> str:
        """A text, number or truth value as JSON writes it.

        Raises:
            StationAnswerError: it is none of them.
        """
        value = self.value(path)
        if isinstance(value, bool):
            return str(value).lower()
        if isinstance(value, str | int | float):
            return str(value)
        raise self._wrong(path, f"is no simple value ({value!r:.40})")

    def _wrong(self, path: str, what: str) -> StationAnswerError:
        return StationAnswerError(
            f"{path} {what} in the answer of {self._name}. "
            "Compare the answer with [station.http] in the configuration."
        )


def _none() -> JsonValue:
    raise LookupError
