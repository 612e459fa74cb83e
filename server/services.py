"""Everything the API may ask for, put together by the composition root."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime

from drivers.simulator.garage import SimulatedGarage
from server.access import Access
from server.adjusting import RunningSettings
from server.calibration.drift.service import SelfCalibration
from server.calibration.measuring import Measuring
from server.calibration.routines.desk import RoutineDesk
from server.calibration.versions.service import Calibrations
from server.charge_point import ChargePointService
from server.config.settings import Settings
from server.control.jog import Jog
from server.control.seat import ControlSeat
from server.control.supervisor import Supervisor
from server.divergence import DivergenceWatcher
from server.events import EventLog
from server.guidance.guide import Guide
from server.jobs.outlook.watch import OutlookWatch
from server.jobs.runner import JobRunner
from server.live.camera_feed import CameraFeed
from server.live.hub import LiveHub
from server.live.station_watch import StationWatch
from server.push.service import PushService
from server.recordings.playbacks import Playbacks
from server.recordings.store import RecordingStore
from server.simulated_car import SimulatedCar
from server.simulated_hand import SimulatedHand
from server.storage.accuracy_checks import AccuracyCheckStore
from server.storage.database import Database
from server.storage.jobs import JobStore
from server.storage.vehicles import VehicleStore
from server.technician.tools import TechnicianTools
from server.timing import Calendar
from server.webhooks.service import Webhooks
from twin.scene import TwinHost


@dataclass(frozen=True, slots=True)
class Services:
    """The running parts of PlugPilot.

    Attributes:
        settings: The whole configuration.
        calendar: Dates.
        started_at: When PlugPilot was started.
        database: Storage.
        access: Who may do what.
        jobs: Jobs and their journals.
        vehicles: Known vehicles.
        supervisor: Owner of the robot.
        jog: Moves one axis for a person.
        seat: Which person is in control.
        runner: Runs jobs.
        outlook: When the running job reaches what people wait for.
        station: Newest reading of the charging station.
        camera: Pictures for people.
        live: Pushes what changes.
        calibrations: What is known of this very robot.
        measuring: Measures it, on purpose and in jobs.
        divergence: Runs the model beside the robot.
        guide: Tells arriving drivers how far to go.
        recordings: What was recorded of jobs.
        playbacks: The same for the 3D picture.
        running_settings: The settings that may change while PlugPilot runs.
        events: What has happened lately.
        webhooks: Who is told what happens.
        push: Notifications on phones.
        charge_point: Robot and station as one charger.
        twin: The 3D picture; None where nobody can watch.
        garage: The simulated garage with a simulated robot in it; None with a real robot.
        simulated_hand: Holds the calibration board before a simulated camera; None before a real
            one.
        simulated_car: The car of the simulated garage; None before a real camera.
        technician: What the technician's page asks for.
    """

    settings: Settings
    calendar: Calendar
    started_at: datetime
    database: Database
    access: Access
    jobs: JobStore
    vehicles: VehicleStore
    supervisor: Supervisor
    jog: Jog
    seat: ControlSeat
    runner: JobRunner
    outlook: OutlookWatch
    station: StationWatch
    camera: CameraFeed
    live: LiveHub
    calibrations: Calibrations
    measuring: Measuring
    divergence: DivergenceWatcher
    guide: Guide
    recordings: RecordingStore
    playbacks: Playbacks
    running_settings: RunningSettings
    events: EventLog
    webhooks: Webhooks
    push: PushService
    charge_point: ChargePointService
    twin: TwinHost | None
    garage: SimulatedGarage | None
    simulated_car: SimulatedCar | None
    simulated_hand: SimulatedHand | None
    technician: TechnicianTools

    @property
    def routines(self) -> RoutineDesk:
        """Measures the robot on purpose."""
        return self.measuring.routines

    @property
    def self_calibration(self) -> SelfCalibration:
        """Learns from jobs how the robot changes."""
        return self.measuring.drift

    @property
    def accuracy_checks(self) -> AccuracyCheckStore:
        """How exactly the robot went where it was sent."""
        return self.measuring.checks
