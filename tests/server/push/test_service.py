"""Notifications over real sockets: encrypted, signed, tried again, and gone with the device."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from dataclasses import dataclass
from ipaddress import ip_network
from pathlib import Path

import pytest
from py_vapid import Vapid02

from server.access import Access, Role
from server.config.access import AccessSettings
from server.config.push import PushSettings
from server.events import EventLog
from server.jobs.model import JobPhase, JobState
from server.push.errors import PushRefusedError
from server.push.service import PushService
from server.push.store import PushStore
from server.schema.events import JobEnded, JobHappened, NeedsPersonEvent, PersonNeeded
from server.schema.jobs import JobResult
from server.schema.robot import RobotFault
from server.storage.database import Database
from server.timing import Calendar
from server.webhooks.sending import HttpSender
from tests.browser.scenes import NOW
from tests.server.push.browser import PushBrowser, PushServiceStage, push_service
from tests.support.eventually import eventually
from tests.support.jobs import job_of

SETTINGS = PushSettings(
    allowed_networks=(ip_network("127.0.0.0/8"),), retry_after_s=(0.0, 0.02, 0.02)
)


@dataclass
class Home:
    """A robot with one paired phone, and the push service of its browser."""

    push: PushService
    access: Access
    events: EventLog
    calendar: Calendar
    service: PushServiceStage
    browser: PushBrowser
    device_id: str

    async def subscribe(self) -> None:
        """The phone wants to be told."""
        wanted = self.browser.subscription(f"{self.service.url}/send/1")
        await self.push.subscribe(self.device_id, wanted)

    def end_job(self, state: JobState = JobState.SUCCEEDED) -> None:
        """A charge ends."""
        ended = job_of(NOW, state=state, phase=JobPhase.PARKING, result=JobResult(energy_wh=21_480))
        self.events.tell(
            JobEnded(id=self.events.new_id(), timestamp=NOW, data=JobHappened(job=ended))
        )

    def need_person(self) -> None:
        """The robot cannot go on alone."""
        reason = RobotFault(
            code="label_not_found", title="Label not found", detail="No label.", remedy="Look."
        )
        data = PersonNeeded(needed=True, reason=reason)
        self.events.tell(NeedsPersonEvent(id=self.events.new_id(), timestamp=NOW, data=data))


@asynccontextmanager
async def _home(folder: Path, settings: PushSettings = SETTINGS) -> AsyncIterator[Home]:
    calendar = Calendar()
    async with push_service(folder / "tls") as service:
        database = Database(folder)
        await database.open()
        access = Access(database, calendar, AccessSettings())
        await access.start()
        person = await access.register.add_person("Anna", Role.VIEWER, None)
        device, _ = await access.register.add_device(person, "Phone", "")
        events = EventLog()
        push = PushService(
            store=PushStore(database),
            register=access.register,
            events=events,
            sender=HttpSender(lambda: settings, trusted=service.trusted),
            settings=settings,
            calendar=calendar,
        )
        await push.start()
        try:
            yield Home(push, access, events, calendar, service, PushBrowser(), device.id)
        finally:
            await push.close()
            await access.close()
            await database.close()


async def test_a_phone_hears_that_the_car_is_charged(tmp_path: Path) -> None:
    async with _home(tmp_path) as home:
        await home.subscribe()
        assert (await home.push.state(home.device_id)).subscribed
        home.end_job()
        await home.service.wait(1)
        (message,) = home.service.messages(home.browser)
        (pushed,) = home.service.received
    assert message == {"kind": "charged", "language": "en", "detail": "", "energy_wh": 21_480}
    assert pushed.path == "send/1"
    assert pushed.headers["content-encoding"] == "aes128gcm"
    assert pushed.headers["urgency"] == "normal"
    assert int(pushed.headers["ttl"]) > 0
    assert Vapid02.verify(pushed.headers["authorization"])
    assert b"charged" not in pushed.body


async def test_a_question_is_urgent_and_a_cancelled_job_is_no_news(tmp_path: Path) -> None:
    async with _home(tmp_path) as home:
        await home.subscribe()
        home.end_job(JobState.CANCELLED)
        home.need_person()
        await home.service.wait(1)
        (message,) = home.service.messages(home.browser)
        assert (message["kind"], message["detail"]) == ("needs_person", "Label not found")
        assert home.service.received[0].headers["urgency"] == "high"


async def test_what_did_not_arrive_is_tried_again(tmp_path: Path) -> None:
    async with _home(tmp_path) as home:
        await home.subscribe()
        home.service.answers = [503, 429, 201]
        home.end_job()
        await home.service.wait(3)
        assert len({pushed.body for pushed in home.service.received}) == 1


@pytest.mark.parametrize("status", [404, 410])
async def test_a_subscription_that_is_gone_is_forgotten(tmp_path: Path, status: int) -> None:
    async with _home(tmp_path) as home:
        await home.subscribe()
        home.service.answers = [status]
        home.end_job()
        await home.service.wait(1)

        async def forgotten() -> bool:
            return not (await home.push.state(home.device_id)).subscribed

        await eventually(forgotten)
        assert len(home.service.received) == 1


async def test_a_removed_device_hears_nothing(tmp_path: Path) -> None:
    async with _home(tmp_path) as home:
        await home.subscribe()
        await home.access.register.remove_device(home.device_id)
        assert not (await home.push.state(home.device_id)).subscribed
        other = await home.access.register.add_person("Ben", Role.VIEWER, home.calendar.now())
        ended, _ = await home.access.register.add_device(other, "Phone", "")
        await home.push.subscribe(ended.id, home.browser.subscription(f"{home.service.url}/2"))
        home.end_job()
        home.need_person()
        await home.push.close()
        assert home.service.received == [], "rights that have ended, and a device that was removed"


async def test_the_key_stays_the_same(tmp_path: Path) -> None:
    async with _home(tmp_path) as home:
        before = (await home.push.state(home.device_id)).public_key
    async with _home(tmp_path) as home:
        assert (await home.push.state(home.device_id)).public_key == before


async def test_only_push_services_outside_are_reached(tmp_path: Path) -> None:
    async with _home(tmp_path, PushSettings()) as home:
        for endpoint in (
            "http://push.example.net/1",
            "https://127.0.0.1/1",
            "https://[::1]/1",
            "https://192.168.1.1/admin",
            "https://user:secret@push.example.net/1",
            "ftp://push.example.net/1",
        ):
            with pytest.raises(PushRefusedError):
                await home.push.subscribe(home.device_id, home.browser.subscription(endpoint))
        wrong = home.browser.subscription("https://8.8.8.8/1").model_copy(update={"auth": "AAAA"})
        with pytest.raises(PushRefusedError, match="keys"):
            await home.push.subscribe(home.device_id, wrong)
        assert not (await home.push.state(home.device_id)).subscribed
