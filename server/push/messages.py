"""Which events a phone is told of, and how urgently."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Literal

from server.jobs.model import JobState
from server.schema.events import Event, JobEnded, NeedsPersonEvent
from server.schema.push import PushLanguage

Kind = Literal["charged", "ended", "failed", "needs_person"]
Urgency = Literal["normal", "high"]

TOPIC = "plugpilot"
"""A newer message replaces an older one that a push service still keeps (RFC 8030, 5.4)."""


@dataclass(frozen=True, slots=True)
class Message:
    """What a phone shows.

    Attributes:
        kind: Chooses the words; the phone has them in its language.
        urgency: Whether a phone that saves power is woken (RFC 8030, 5.3).
        ttl_s: So long a push service keeps it for a phone that is off.
        detail: In English, what has happened; shown where that is the language.
        energy_wh: What was charged.
    """

    kind: Kind
    urgency: Urgency
    ttl_s: int
    detail: str = ""
    energy_wh: float | None = None

    def payload(self, language: PushLanguage) -> bytes:
        """What the service worker of the page reads (web/src/worker/push.ts)."""
        shown = {
            "kind": self.kind,
            "language": language,
            "detail": self.detail[:300] if language == "en" else "",
            "energy_wh": self.energy_wh,
        }
        return json.dumps(shown).encode()


def message_of(event: Event) -> Message | None:
    """What to tell, or None: most of what happens is worth no notification."""
    match event:
        case NeedsPersonEvent(data=data) if data.needed and data.reason is not None:
            return Message("needs_person", "high", 12 * 3600, data.reason.title)
        case JobEnded(data=data) if data.job.state is JobState.FAILED:
            error = data.job.error
            return Message("failed", "high", 12 * 3600, error.title if error else "")
        case JobEnded(data=data) if data.job.state is JobState.SUCCEEDED:
            energy_wh = data.job.result.energy_wh
            if data.job.type.value == "charge" and energy_wh:
                return Message("charged", "normal", 4 * 3600, energy_wh=energy_wh)
            return Message("ended", "normal", 4 * 3600)
        case _:
            return None
