"""What the energy of a job costs, by the price at the time it flows.

Between two readings of the meter the energy is taken to flow evenly, so that a reading that comes
late, as after a restart, is divided among the prices of the time that it spans.
"""

from __future__ import annotations

from datetime import datetime, time, timedelta, tzinfo
from zoneinfo import ZoneInfo

from server.config.tariff import TariffSettings


class CostMeter:
    """Adds up.

    Attributes:
        cost: Up to now, in the currency.
        at: When the meter was read last.

    Args:
        tariff: What energy costs; it names a currency.
        energy_wh: Energy of the job so far [Wh].
        cost: What that cost.
        at: When that was so.
    """

    def __init__(
        self, tariff: TariffSettings, *, energy_wh: float, cost: float, at: datetime
    ) -> None:
        self._tariff = tariff
        self._energy_wh = energy_wh
        self.at = at
        self.cost = cost

    def read(self, energy_wh: float, at: datetime) -> None:
        """Take in a reading of the energy of the job [Wh]; one that is not more adds nothing."""
        if energy_wh > self._energy_wh:
            price = mean_price(self._tariff, self.at, at)
            self.cost += (energy_wh - self._energy_wh) / 1000 * price
            self._energy_wh = energy_wh
        self.at = at


def mean_price(tariff: TariffSettings, begin: datetime, end: datetime) -> float:
    """The price of energy that flows evenly from one date to another [currency per kWh].

    Args:
        tariff: What energy costs.
        begin: An aware date.
        end: Another one; when it is not later, the price at this instant is meant.
    """
    if end <= begin:
        return price_at(tariff, end)
    zone = _zone(tariff, begin)
    paid, now = 0.0, begin
    while now < end:
        until = min(_next_border(tariff, now, zone), end)
        paid += price_at(tariff, now) * (until - now).total_seconds()
        now = until
    return paid / (end - begin).total_seconds()


def price_at(tariff: TariffSettings, date: datetime) -> float:
    """The price at an instant [currency per kWh]."""
    clock = date.astimezone(_zone(tariff, date)).time()
    for window in tariff.windows:
        for begin, end in window.spans:
            if begin <= clock and (end is None or clock < end):
                return window.price_per_kwh
    return tariff.price_per_kwh


def _zone(tariff: TariffSettings, date: datetime) -> tzinfo | None:
    if tariff.time_zone is not None:
        return ZoneInfo(tariff.time_zone)
    return date.astimezone().tzinfo


def _next_border(tariff: TariffSettings, date: datetime, zone: tzinfo | None) -> datetime:
    """When the price may change next; midnight at the latest.

    The wall clock jumps twice a year, so the borders are found on it and counted in real time.
    """
    local = date.astimezone(zone)
    borders = {time.min}
    for window in tariff.windows:
        borders |= {window.begin, window.end}
    later = [
        datetime.combine(local.date() + timedelta(days=days), border, zone).astimezone(date.tzinfo)
        for days in (0, 1)
        for border in borders
    ]
    return min(border for border in later if border > date)
