"""The words in which the server speaks about jobs."""

from __future__ import annotations

from enum import StrEnum


class JobType(StrEnum):
    """What a job is to do."""

    CHARGE = "charge"  # plug in, charge, unplug, park
    PLUG_IN = "plug_in"  # plug in and stay
    UNPLUG = "unplug"  # release, withdraw, park

    @property
    def in_words(self) -> str:
        """Name of such a job at the beginning of a sentence."""
        return _TITLES[self]


_TITLES = {
    JobType.CHARGE: "Charging job",
    JobType.PLUG_IN: "Plug-in job",
    JobType.UNPLUG: "Unplugging job",
}


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


class Milestone(StrEnum):
    """What somebody who watches a job waits for."""

    PLUGGED = "plugged"  # the plug is seated
    CHARGED = "charged"  # the charging is over
    UNPLUGGED = "unplugged"  # the robot is parked, and the car may drive


class PersonChoice(StrEnum):
    """What a person may answer to a job that asks."""

    RESUME = "resume"  # go on by what can be seen then
    CANCEL = "cancel"  # bring the plug back to its parking place, as far as that is possible
