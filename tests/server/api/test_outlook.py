"""The time left over REST."""

from __future__ import annotations

from datetime import timedelta

import httpx
from pydantic import TypeAdapter

from server.jobs.model import JobPhase, JobType, Milestone
from server.schema.outlook import Outlook
from tests.support.api import on_api
from tests.support.garage import Scene

_ANSWER: TypeAdapter[Outlook | None] = TypeAdapter(Outlook | None)


def test_the_running_jobs_next_milestone_is_told_and_null_without_one() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        async def read() -> Outlook | None:
            answer = await client.get("outlook")
            assert answer.status_code == 200
            return _ANSWER.validate_json(answer.content)

        assert await read() is None
        await scene.start(JobType.PLUG_IN)
        await scene.until_phase(JobPhase.ALIGNING)
        told = await read()
        assert told is not None
        assert told.milestone is Milestone.PLUGGED
        left = told.at - scene.services.calendar.now()
        assert timedelta(seconds=3) < left < timedelta(seconds=12)

    on_api(scenario, parked=True)
