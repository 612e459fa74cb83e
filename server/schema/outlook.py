"""What people wait for, as the API shows it."""

from __future__ import annotations

from pydantic import Field

from server.jobs.model import Milestone
from server.schema.base import Timestamp, Wire


class Outlook(Wire):
    """When the running job reaches its next milestone, as far as that can be told."""

    milestone: Milestone
    at: Timestamp = Field(
        description="From this robot's earlier jobs, and from the energy still to come"
    )
    latest: bool = Field(
        description="Then at the latest, because the car is to be unplugged; it may be earlier"
    )
