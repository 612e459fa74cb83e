"""Measures one link to a board: what came, what came damaged, what had to be said twice."""

from __future__ import annotations

from drivers.arduino.link.go_back_n import NUMBERS
from drivers.arduino.protocol.messages import Telemetry
from drivers.arduino.session import Session
from drivers.arduino.tap import TappedLine
from drivers.arduino.telemetry import supply_v, temperature_degc
from drivers.robot.link_health import LinkHealth, RoundTrip


class LinkGauge:
    """Counts from its making on.

    That is after the board has introduced itself: what a boot loader says before is no damage.

    Args:
        line: To the board.
        session: On that line.
    """

    def __init__(self, line: TappedLine, session: Session) -> None:
        self._line = line
        self._session = session
        self._damaged_before = line.damaged or 0
        self._damaged_at_board = 0
        self._sample: Telemetry | None = None

    def take(self, sample: Telemetry) -> None:
        """The newest sample of the board."""
        if self._sample is not None:
            # the board counts modulo 256, and tells at least ten times a second
            self._damaged_at_board += (sample.bad_frames - self._sample.bad_frames) % NUMBERS
        self._sample = sample

    def read(self, reconnections: int) -> LinkHealth:
        """The link now.

        Args:
            reconnections: How often it was opened anew.
        """
        damaged, sample = self._line.damaged, self._sample
        return LinkHealth(
            reconnections=reconnections,
            round_trip=RoundTrip.of(self._session.clock.round_trips_s),
            received=self._session.received,
            damaged=None if damaged is None else damaged - self._damaged_before,
            damaged_at_board=None if sample is None else self._damaged_at_board,
            sent_again=self._session.sent_again,
            supply_v=None if sample is None else supply_v(sample),
            temperature_degc=None if sample is None else temperature_degc(sample),
        )
