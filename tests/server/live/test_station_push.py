"""A station that tells by itself what has changed is read at once."""

from __future__ import annotations

import asyncio

from drivers.station.memory import StationMemory
from drivers.station.openevse import OpenevseStation
from drivers.station.settings import OpenevseSettings
from server.live.station_watch import StationWatch
from tests.support.eventually import eventually
from tests.support.fake_stations.openevse import FakeOpenevse
from tests.support.fake_stations.serving import serving

A_LONG_TIME_S = 1000.0


async def test_a_push_is_seen_without_waiting_for_the_next_reading() -> None:
    fake = FakeOpenevse()
    read = asyncio.Event()
    async with serving(fake.app) as url:
        station = OpenevseStation(OpenevseSettings(url=url), StationMemory())
        watch = StationWatch(station, A_LONG_TIME_S, read.set)
        await station.open()
        await watch.start()
        await asyncio.wait_for(station.push.connected.wait(), 10)
        read.clear()
        fake.plug(7.0)
        await fake.push('{"state": 3, "amp": 30000, "vehicle": 1}')
        await eventually(lambda: watch.snapshot is not None and watch.snapshot.carries_load)

        asked = len(fake.requests)
        for _ in range(50):
            await fake.push('{"state": 3, "amp": 30000, "vehicle": 1}')
            await fake.push('{"time": "2026-03-01T18:04:05Z", "temp": 31.5}')
        await fake.push('{"state": 254, "amp": 0, "vehicle": 1}')
        fake.override = {"state": "disabled", "auto_release": False}
        await eventually(lambda: watch.snapshot is not None and not watch.snapshot.carries_load)
        assert len(fake.requests) - asked <= 4, "what says nothing new wakes nobody"
        await watch.close()
        await station.close()
