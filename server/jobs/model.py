"""The words in which the server speaks about jobs."""

from __future__ import annotations

from enum import StrEnum


class JobType(StrEnum):
    """What a job is to do."""

    CHARGE = "charge"  # plug in, charge, unplug, park
    PLUG_IN = "plug_in"  # plug in and stay
    UNPLUG = "unplug"  # release, withdraw, park


class JobState(StrEnum):
    """Where a job is in its life."""

    QUEUED = "queued"
    RUNNING = "running"
    SUCCEEDED = "succeeded"
    FAILED = "failed"
    CANCELLED = "cancelled"

    @property
    def ended(self) -> bool:
        """Nothing more will happen to the job."""
        return self not in {JobState.QUEUED, JobState.RUNNING}


class JobPhase(StrEnum):
    """What a running job is doing."""

    PREFLIGHT = "preflight"
    LOCATING = "locating"
    ALIGNING = "aligning"
    INSERTING = "inserting"
    PLUGGED = "plugged"
    CHARGING = "charging"
    RELEASING = "releasing"
    WITHDRAWING = "withdrawing"
    PARKING = "parking"
