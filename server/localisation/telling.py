"""What a search that found nothing has to tell."""

from __future__ import annotations

from collections.abc import Iterable

from server.localisation.eye import Refusal
from server.vision.errors import NoCodeError


def most_telling(refusals: Iterable[Refusal | None]) -> Refusal | None:
    """What was wrong with the first picture that showed anything; None if none did.

    A picture that is too dark or too bright shows something: that it is so.
    """
    for refusal in refusals:
        if refusal is not None and type(refusal) is not NoCodeError:
            return refusal
    return None
