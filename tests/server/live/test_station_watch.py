from __future__ import annotations

import asyncio

from drivers.station import PilotState
from server.live.station_watch import StationWatch
from tests.support.robot_cell import RobotCell, in_cell


def test_it_reads_regularly_and_says_when_the_station_is_silent() -> None:
    async def scenario(cell: RobotCell) -> None:
        station = cell.garage.station
        await station.close()
        changes: list[bool] = []
        watch = StationWatch(station, 1.0, lambda: changes.append(watch.online))
        await watch.start()
        assert [watch.online] == [False], "the station is not open yet"
        assert [watch.snapshot] == [None]
        await station.open()
        await asyncio.sleep(3.5)
        assert watch.online
        assert watch.snapshot is not None
        assert watch.snapshot.pilot is PilotState.A
        assert watch.name == station.name
        station.hang()
        await asyncio.sleep(5.0)
        assert [watch.online] == [False]
        age_s = asyncio.get_running_loop().time() - watch.snapshot.sampled_at_s
        assert age_s > 3.0, "the old reading keeps its own time"
        station.behave()
        await asyncio.sleep(5.0)
        assert watch.online
        await watch.close()
        count = len(changes)
        await asyncio.sleep(10.0)
        assert len(changes) == count
        assert {True, False} == set(changes)

    in_cell(scenario)
