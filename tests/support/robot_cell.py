"""A supervisor on a simulated robot in virtual time, with everything a test wants to look at."""

from __future__ import annotations

from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager
from dataclasses import dataclass, field
from typing import TypeVar

from drivers.camera import pi_camera_v2
from drivers.robot import RobotState
from drivers.simulator.garage import SimulatedGarage, build_garage
from drivers.simulator.parameters import SimulationParameters
from server.config.supervision import SupervisionSettings
from server.control.jog import Jog
from server.control.model import Holder, PlugState, RobotMode
from server.control.plug_guard import PlugRecord
from server.control.supervisor import Supervisor
from server.timing import Calendar
from tests.support.virtual import run_virtual
from twin.camera_mount import CameraMount
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.motion.limits import MotionLimits

T = TypeVar("T")

GEOMETRY = RobotGeometry()
LIMITS = MotionLimits()
HOME = JointPosition(150.0, 150.0, 50.0)
"""Where the simulated homing ends."""

AWAY = JointPosition(210.0, 170.0, 60.0)


def parameters(**board: object) -> SimulationParameters:
    """A perfect machine that wakes up homed; numbers of the board may be changed."""
    perfect = SimulationParameters.perfect()
    changed = type(perfect.board).model_validate(
        {**dict(perfect.board), "start_homed": True, **board}
    )
    return perfect.model_copy(update={"board": changed})


class MemoryPlug:
    """A plug store that remembers every record in order, and fails when told to."""

    def __init__(self, record: PlugRecord | None = None) -> None:
        self.records: list[PlugRecord] = [record] if record else []
        self.failure: Exception | None = None
        self.saving: Callable[[PlugRecord], Awaitable[None]] | None = None

    async def load(self) -> PlugRecord | None:
        return self.records[-1] if self.records else None

    async def save(self, record: PlugRecord) -> None:
        if self.saving is not None:
            await self.saving(record)
        if self.failure is not None:
            raise self.failure
        self.records.append(record)


@dataclass
class RobotCell:
    """One robot and who owns it."""

    garage: SimulatedGarage
    supervisor: Supervisor
    jog: Jog
    store: MemoryPlug
    samples: list[RobotState] = field(default_factory=list)

    @property
    def robot(self) -> RobotState:
        """The newest sample."""
        return self.supervisor.telemetry.require()

    @property
    def now(self) -> JointPosition:
        """Where the joints are at this moment, not when the last sample was taken."""
        return self.garage.robot._board.sample(self.garage.robot._now()).measured.position

    def mode(self) -> RobotMode:
        """What the robot is doing."""
        return self.supervisor.mode

    def plug(self) -> PlugState:
        """Where the plug is."""
        return self.supervisor.plug.state

    def holder(self) -> Holder | None:
        """Who has control."""
        return self.supervisor.holder

    def moving(self) -> bool:
        """Whether anything moves at this moment, by more than the last tenths of settling."""
        now_s = self.garage.robot._now()
        sample = self.garage.robot._board.sample(now_s)
        fastest = max(abs(v) for v in sample.measured.velocity)
        return fastest > 1.0 or now_s < self.garage.world.line.rests_from_s


@asynccontextmanager
async def robot_cell(
    numbers: SimulationParameters | None = None,
    *,
    store: MemoryPlug | None = None,
    enabled: bool = True,
    seed: int = 1,
    settings: SupervisionSettings | None = None,
) -> AsyncIterator[RobotCell]:
    """A running supervisor."""
    garage = build_garage(
        GEOMETRY, LIMITS, CameraMount(), pi_camera_v2(), numbers or parameters(), seed=seed
    )
    store = store or MemoryPlug()
    await garage.station.open()
    supervisor = Supervisor(
        garage.robot,
        GEOMETRY,
        LIMITS,
        store,
        Calendar(),
        station=garage.station,
        settings=settings or SupervisionSettings(),
    )
    cell = RobotCell(garage, supervisor, Jog(supervisor), store)

    def keep() -> None:
        state = supervisor.telemetry.latest
        if state is not None and (not cell.samples or cell.samples[-1] is not state):
            cell.samples.append(state)

    supervisor.listen(keep)
    await supervisor.start()
    try:
        if enabled:
            async with supervisor.control("jog", "Test") as lease:
                await supervisor.enable(lease)
        yield cell
    finally:
        await supervisor.close()


def in_cell(
    scenario: Callable[[RobotCell], Awaitable[T]],
    numbers: SimulationParameters | None = None,
    *,
    store: MemoryPlug | None = None,
    enabled: bool = True,
    seed: int = 1,
    settings: SupervisionSettings | None = None,
) -> T:
    """Run a scenario in virtual time."""

    async def main() -> T:
        async with robot_cell(
            numbers, store=store, enabled=enabled, seed=seed, settings=settings
        ) as cell:
            return await scenario(cell)

    return run_virtual(main())
