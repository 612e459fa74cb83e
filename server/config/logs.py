"""What is written to the log."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from server.config.section import Section


class LoggingSettings(Section):
    """The log goes to the standard error stream."""

    level: Literal["debug", "info", "warning", "error"] = Field(
        "info", description="The least important kind of line that is written"
    )
