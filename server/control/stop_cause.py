"""Why a protective stop is in force, in words a person can act on."""

from __future__ import annotations

from dataclasses import dataclass

from server.control.errors import RobotStoppedError, TelemetryStaleError


@dataclass(frozen=True, slots=True)
class StopCause:
    """What brought a protective stop about.

    Attributes:
        code: Stable name.
        words: A sentence for people.
        by_person: Somebody pressed it, so only a person releases it.
        error: What the interrupted motion ends with.
    """

    code: str
    words: str
    by_person: bool
    error: type[RobotStoppedError]

    def as_error(self) -> RobotStoppedError:
        """The error of whoever wants to move while this stop is in force."""
        return self.error(self.words)


PRESSED = StopCause("pressed", "Somebody pressed stop.", by_person=True, error=RobotStoppedError)


def stale_telemetry(age_s: float) -> StopCause:
    """The news of a moving robot were too old."""
    return StopCause(
        "telemetry_stale",
        f"The newest news of the moving robot were {1e3 * age_s:.0f} ms old.",
        by_person=False,
        error=TelemetryStaleError,
    )
