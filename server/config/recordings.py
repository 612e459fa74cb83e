"""What is kept of each job to be watched again."""

from __future__ import annotations

from pydantic import Field

from server.config.section import Section

MEGABYTE = 1_000_000


class RecordingSettings(Section):
    """Recordings lie in the data folder; the oldest make room for new ones."""

    enabled: bool = Field(True, description="Record jobs at all")
    max_count: int = Field(200, ge=1, le=100_000, description="Recordings that are kept")
    max_total_mb: float = Field(
        2000.0, gt=0, le=1e6, description="What they may take together, 3D playbacks included"
    )
    max_age_days: float = Field(365.0, gt=0, le=36_500, description="Older ones are deleted")
    max_one_mb: float = Field(
        200.0, gt=0, le=1e5, description="One recording ends here; its job goes on"
    )
    min_free_mb: float = Field(
        200.0, ge=0, le=1e6, description="With less free space on the disk nothing is recorded"
    )
    pictures: int = Field(
        24, ge=0, le=1000, description="Pictures kept of one job: those that poses came from"
    )
    picture_interval_s: float = Field(
        0.2, ge=0, le=60, description="Shortest time between two of them"
    )
    playback_rate_hz: float = Field(20.0, ge=5, le=30, description="Of the 3D playback")
    playback_pause_s: float = Field(
        2.0, ge=0.5, le=60, description="Longer waits without motion are cut down to this"
    )
