"""What a phase has at hand."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from dataclasses import dataclass, field
from datetime import datetime

from drivers.station import StationDriver
from server.config.settings import Settings
from server.control.lease import Lease
from server.control.supervisor import Supervisor
from server.jobs.cost import CostMeter
from server.jobs.journal import Journal
from server.localisation.eye import Eye
from server.localisation.socket_pose import SocketPose
from server.schema.vehicles import Vehicle
from server.timing import Calendar
from twin.joints import JointPosition


@dataclass(slots=True)
class JobContext:
    """The robot, the camera, the station and the job that uses them.

    Attributes:
        supervisor: Owner of the robot.
        lease: Proof of control for the length of the job.
        eye: Camera and locator.
        station: The charging station.
        vehicle: Whose socket it is about; None when unplugging a car that nobody knows any more.
        settings: The whole configuration.
        journal: Of this job.
        accepted_at_s: Event loop time at which the job was accepted.
        start: Where the robot waited when its motion began.
        calendar: Dates, for what is to happen by a certain time.
        restarted: It was begun before PlugPilot was started.
        finish: Set when somebody wants the charging to end now.
        socket: The socket as last measured.
        energy_wh: Energy charged so far; None before the charging began.
        cost: What that costs; None before the charging began, and without a tariff.
        on_sighting: Shows every new pose of the socket.
    """

    supervisor: Supervisor
    lease: Lease
    eye: Eye
    station: StationDriver
    vehicle: Vehicle | None
    settings: Settings
    journal: Journal
    accepted_at_s: float
    start: JointPosition
    calendar: Calendar
    restarted: bool = False
    finish: asyncio.Event = field(default_factory=asyncio.Event)
    socket: SocketPose | None = None
    energy_wh: float | None = None
    cost: CostMeter | None = None
    on_sighting: Callable[[SocketPose], None] = lambda _: None

    def count_cost(self) -> None:
        """Count the cost from what is kept: a job that goes on has cost something already."""
        tariff, known = self.settings.tariff, self.journal.job
        if tariff.currency is None:
            return
        self.cost = CostMeter(
            tariff,
            energy_wh=known.result.energy_wh or 0.0,
            cost=known.result.cost or 0.0,
            at=known.result.cost_at or self.calendar.now(),
        )

    @property
    def cost_so_far(self) -> dict[str, float | str | datetime]:
        """Of the job's result; empty where no cost is counted."""
        currency = self.settings.tariff.currency
        if self.cost is None or currency is None:
            return {}
        return {"cost": round(self.cost.cost, 4), "currency": currency, "cost_at": self.cost.at}

    def see(self, socket: SocketPose) -> None:
        """Take over a new pose of the socket and show it."""
        self.socket = socket
        self.on_sighting(socket)

    def require_vehicle(self) -> Vehicle:
        """The vehicle; known in every job that has to find a socket."""
        if self.vehicle is None:
            raise AssertionError("a job that looks for a socket was accepted without a vehicle")
        return self.vehicle

    def require_socket(self) -> SocketPose:
        """The socket as last measured; a phase that needs it comes after one that measures it."""
        if self.socket is None:
            raise AssertionError("the socket was not measured before it was needed")
        return self.socket
