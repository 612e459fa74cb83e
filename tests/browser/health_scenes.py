"""A link to the board and a camera whose figures go on from one question to the next."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from datetime import timedelta
from itertools import count
from typing import Any

import numpy as np
from playwright.sync_api import Page

from server.schema.inspection import CameraInspection
from server.schema.link import LinkReport

Json = Any

BURST_EVERY_S, BURST_S = 100, 8
"""Now and then a motor disturbs the cable."""

STEP_S = 4
ASKED_OFTEN = 40
"""So many answers, so far apart, fill some minutes of the curves."""

_rng = np.random.default_rng(11)
_seconds = count(step=STEP_S)
_looks = count()


def next_report(published: Json) -> Json:
    """The link some seconds later than at the question before."""
    example = LinkReport.model_validate(published)
    second = next(_seconds)
    assert example.round_trip is not None
    disturbed = second % BURST_EVERY_S < BURST_S
    bursts, into_burst = divmod(second, BURST_EVERY_S)
    damaged = BURST_S * bursts + min(into_burst + 1, BURST_S)
    newest_s = 0.0012 + float(_rng.gamma(2.0, 0.0003)) + (0.018 if disturbed else 0.0)
    trip = {"newest_s": newest_s, "worst_s": max(newest_s, example.round_trip.worst_s)}
    return example.model_copy(
        update={
            "at": example.at + timedelta(seconds=second),
            "telemetry_hz": float(_rng.normal(10.0, 0.05)),
            "sample_age_s": float(_rng.uniform(0.003, 0.1)),
            "sample_delay_s": 0.002 + float(_rng.gamma(2.0, 0.0004)),
            "round_trip": example.round_trip.model_copy(update=trip),
            "received": 18_204 + 12 * second,
            "damaged": damaged,
            "sent_again": 2 * (bursts + 1),
        }
    ).model_dump(mode="json")


def next_look(published: Json) -> Json:
    """The next picture of the camera."""
    example = CameraInspection.model_validate(published)
    number = next(_looks)
    return example.model_copy(
        update={
            "sequence": example.sequence + number,
            "taken_at": example.taken_at + timedelta(seconds=STEP_S * number),
            "frames_per_s": float(_rng.normal(29.9, 0.3)),
            "age_s": 0.075 + float(_rng.gamma(2.0, 0.008)),
        }
    ).model_dump(mode="json")


NEXT: Mapping[str, Callable[[Json], Json]] = {
    "robot/link": next_report,
    "camera/inspection": next_look,
}
"""What is answered to each question anew, from the published example."""

_QUESTIONS = {"link": "/robot/link", "camera": "/camera/inspection?"}


def fill_curves(page: Page, panel: str) -> None:
    """Wait until the curves of a panel, if it has any, have something to show.

    Pauses of a second take no time from then on.
    """
    if panel not in _QUESTIONS:
        return
    page.evaluate(
        "() => { const wait = window.setTimeout;"
        " window.setTimeout = (what, ms) => wait(what, ms === 1000 ? 0 : ms); }"
    )
    page.wait_for_function(
        "([path, often]) => performance.getEntriesByType('resource')"
        ".filter(({ name }) => name.includes(path)).length > often",
        arg=[_QUESTIONS[panel], ASKED_OFTEN],
    )
