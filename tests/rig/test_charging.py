"""Whole jobs: server, real driver, real firmware, and a garage around the motors."""

from __future__ import annotations

import pytest

from server.control.model import PlugState
from server.jobs.model import JobState, JobType
from tests.rig.build import Programs
from tests.rig.charger import do_job, plug_of, running_charger


async def test_a_car_is_plugged_in_and_unplugged(programs: Programs) -> None:
    async with running_charger(programs) as charger:
        services, world = charger.services, charger.garage.world

        plugged_in = await do_job(services, JobType.PLUG_IN)
        truth = world.truth()
        assert plugged_in.state is JobState.SUCCEEDED, plugged_in.error
        assert truth.seated
        assert truth.lateral_error_mm is not None
        assert truth.lateral_error_mm < 1.5
        assert truth.max_contact_force_n < 90.0
        assert plugged_in.result.insertion_depth_mm == pytest.approx(
            truth.insertion_depth_mm, abs=1.0
        )
        assert plug_of(services) is PlugState.INSERTED

        unplugged = await do_job(services, JobType.UNPLUG)
        assert unplugged.state is JobState.SUCCEEDED, unplugged.error
        assert not world.truth().seated
        assert plug_of(services) is PlugState.PARKED
        statistics = await charger.rig.control.statistics()
        assert all(rail.lost == 0 for rail in statistics.rails)
