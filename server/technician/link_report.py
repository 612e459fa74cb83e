"""How well the link to the motion board does: by the telemetry, and in its driver's words."""

from __future__ import annotations

import asyncio

from drivers.robot import RobotDriver
from drivers.robot.link_health import LinkHealth, RoundTrip, TellsLinkHealth
from server.control.telemetry import Telemetry
from server.schema.link import LinkReport, RoundTripTimes
from server.timing import Calendar

DIGITS = 6
"""Times are told to the microsecond; below is nothing but noise."""


class LinkReporter:
    """Reports on demand; nothing is at work in between.

    Args:
        robot: The motion board.
        telemetry: What it sends.
        calendar: Dates.
    """

    def __init__(self, robot: RobotDriver, telemetry: Telemetry, calendar: Calendar) -> None:
        self._robot = robot
        self._telemetry = telemetry
        self._calendar = calendar

    def report(self) -> LinkReport:
        """The link now."""
        state, rate_hz = self._telemetry.latest, self._telemetry.rate_hz
        robot = self._robot
        health = robot.link_health() if isinstance(robot, TellsLinkHealth) else LinkHealth()
        age_s = delay_s = None
        if state is not None:
            now_s = asyncio.get_running_loop().time()
            # the board's clock is estimated: a sample may seem to come from the next moment
            age_s = round(max(now_s - state.sampled_at_s, 0.0), DIGITS)
            delay_s = round(max(state.received_at_s - state.sampled_at_s, 0.0), DIGITS)
        return LinkReport(
            at=self._calendar.now(),
            online=state is not None,
            telemetry_hz=None if rate_hz is None else round(rate_hz, 2),
            sample_age_s=age_s,
            sample_delay_s=delay_s,
            round_trip=_times(health.round_trip),
            received=health.received,
            damaged=health.damaged,
            damaged_at_board=health.damaged_at_board,
            sent_again=health.sent_again,
            reconnections=health.reconnections,
            supply_v=health.supply_v,
            temperature_degc=health.temperature_degc,
        )


def _times(round_trip: RoundTrip | None) -> RoundTripTimes | None:
    if round_trip is None:
        return None
    return RoundTripTimes(
        newest_s=round(round_trip.newest_s, DIGITS),
        median_s=round(round_trip.median_s, DIGITS),
        worst_s=round(round_trip.worst_s, DIGITS),
        answers=round_trip.answers,
    )
