"""Makes the parts that other programs speak with, for the composition root."""

from __future__ import annotations

from drivers.station import StationDriver
from server.access import Access
from server.adjusting import RunningSettings
from server.charge_point import ChargePointService
from server.config.push import PushSettings
from server.config.settings import Settings
from server.control.supervisor import Supervisor
from server.events import EventLog
from server.events.sources import EventSources
from server.jobs.runner import JobRunner
from server.live.station_watch import StationWatch
from server.live.views import robot_view
from server.push.service import PushService
from server.push.store import PushStore
from server.services import Services
from server.storage.charge_point import ChargePointStore
from server.storage.database import Database
from server.storage.deliveries import DeliveryStore
from server.storage.settings import ChangedSettingsStore
from server.storage.webhooks import WebhookStore
from server.timing import Calendar
from server.webhooks.sending import HttpSender
from server.webhooks.service import Webhooks


class Integrations:
    """The parts that need no robot, at once; the others when the robot is there.

    Args:
        database: Where they keep what must survive.
        settings: The whole configuration.
        calendar: Dates.
        speed: Seconds of the event loop per second of the dates.
    """

    def __init__(
        self, database: Database, settings: Settings, calendar: Calendar, speed: float
    ) -> None:
        self._database = database
        self._calendar = calendar
        self._speed = speed
        running = RunningSettings(settings, ChangedSettingsStore(database), calendar.now)
        self.running_settings = running
        self.events = EventLog()
        self.webhooks = Webhooks(
            store=WebhookStore(database),
            deliveries=DeliveryStore(database),
            events=self.events,
            sender=HttpSender(lambda: running.current.webhooks, speed),
            settings=lambda: running.current.webhooks,
            calendar=calendar,
            speed=speed,
        )

    def push(self, access: Access, settings: PushSettings) -> PushService:
        """Notifications on the phones of those who are known."""
        return PushService(
            store=PushStore(self._database),
            register=access.register,
            events=self.events,
            sender=HttpSender(lambda: settings, self._speed),
            settings=settings,
            calendar=self._calendar,
            speed=self._speed,
        )

    def charge_point(
        self,
        *,
        supervisor: Supervisor,
        runner: JobRunner,
        station: StationDriver,
        watch: StationWatch,
    ) -> ChargePointService:
        """Robot and station as one charger."""
        return ChargePointService(
            supervisor=supervisor,
            runner=runner,
            station=station,
            watch=watch,
            store=ChargePointStore(self._database),
            settings=lambda: self.running_settings.current.charge_point,
            calendar=self._calendar,
            speed=self._speed,
        )

    def tell_events(self, services: Services) -> None:
        """Let everything that happens be told."""
        EventSources(
            self.events,
            supervisor=services.supervisor,
            runner=services.runner,
            divergence=services.divergence,
            calendar=self._calendar,
            robot=lambda: robot_view(
                services.supervisor, services.runner.socket, services.calendar
            ),
            show=services.recordings.show,
        )
