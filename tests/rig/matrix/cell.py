"""One fault in one situation: what becomes of it, and whether there is a way back."""

from __future__ import annotations

import asyncio
from dataclasses import dataclass, field

from server.control.model import PlugState, RobotMode
from server.jobs.model import JobState, JobType
from tests.rig.build import Programs
from tests.rig.charger import Charger, do_job, plug_of, running_charger
from tests.rig.machine import true_joints
from tests.rig.matrix.faults import FaultCase
from tests.rig.matrix.situations import Activity, Situation
from tests.rig.truth import TrueState
from tests.support.eventually import eventually
from twin.joints import JointPosition

MOVED_MM = 0.005
"""Less between two samples is no motion: one step, or one count of the encoder."""

NOTICE_S = 2.0
STILL_S = 1.0
ENDS_WITHIN_S = 90.0
LINK_WITHIN_S = 20.0
STOPPED_BY_FORCE = {"connector_locked", "insertion_jammed"}
"""The server has stopped the motion itself, maybe before the board would have."""

LATERAL_MM = 0.1
"""What play and rounding amount to."""


@dataclass(frozen=True, slots=True)
class Row:
    """What became of one cell.

    Attributes:
        situation: What was going on.
        fault: What went wrong.
        outcome: "done", "rest", or the code of the error that ended what was going on.
        board: State of the board before anything was mended, or "offline".
        codes: Faults that the board latched, and "link lost".
        plug: Where the server takes the plug to be.
        still_after_s: Standstill after the fault began; None if nothing was ended by it.
    """

    situation: str
    fault: str
    outcome: str
    board: str
    codes: tuple[str, ...]
    plug: str
    still_after_s: float | None

    def line(self) -> str:
        """As a line of the table."""
        still = "-" if self.still_after_s is None else f"{1e3 * self.still_after_s:.0f} ms"
        codes = ", ".join(self.codes) or "-"
        return (
            f"{self.situation:<19}{self.fault:<22}{self.outcome:<20}{self.board:<9}{codes:<32}"
            f"{self.plug:<10}{still:>8}"
        )


HEADING = (
    f"{'situation':<19}{'fault':<22}{'outcome':<20}{'board':<9}{'latched':<32}{'plug':<10}"
    f"{'still':>8}"
)


@dataclass
class _Log:
    """What is to be seen from outside while a fault is there."""

    charger: Charger
    last_motion_s: float = 0.0
    at: JointPosition | None = None
    codes: set[str] = field(default_factory=set)

    def __post_init__(self) -> None:
        self.charger.rig.control.on_sample(self._take)
        self.charger.services.supervisor.listen(self._look)

    def _take(self, sample: TrueState) -> None:
        joints = true_joints(self.charger.rig.machine, sample)
        if self.at is not None and any(
            abs(a - b) > MOVED_MM for a, b in zip(joints, self.at, strict=True)
        ):
            self.last_motion_s = sample.at_s
        self.at = joints

    def _look(self) -> None:
        supervisor = self.charger.services.supervisor
        if supervisor.mode is RobotMode.OFFLINE:
            self.codes.add("link lost")
        elif supervisor.fault is not None:
            self.codes.add(supervisor.fault.code.value)


async def run_cell(programs: Programs, situation: Situation, fault: FaultCase) -> Row:
    """Bring a situation about, spoil it, look, mend it, and find the way back.

    Raises:
        AssertionError: it did not end in a defined safe state, or there was no way back.
    """
    async with running_charger(programs, parked=situation.parked) as charger:
        activity = await situation.enter(charger)
        loop, rig = asyncio.get_running_loop(), charger.rig
        log = _Log(charger)
        began_s = loop.time()
        await fault.begin(rig)
        if fault.lasts_s is not None:
            await asyncio.sleep(fault.lasts_s)
            await fault.mend(rig)
        outcome = await _outcome(activity)
        await asyncio.sleep(NOTICE_S)
        assert loop.time() - log.last_motion_s > STILL_S, "it still moves"

        codes = tuple(sorted(log.codes))
        latest = charger.services.supervisor.telemetry.latest
        ended = outcome not in {"done", "rest"}
        row = Row(
            situation.name,
            fault.name,
            outcome,
            "offline" if latest is None else latest.board.value,
            codes,
            plug_of(charger.services).value,
            max(log.last_motion_s - began_s, 0.0) if ended else None,
        )
        _expect_safe(charger, row, fault)
        await fault.mend(rig)
        await _come_back(charger)
        return row


async def _outcome(activity: Activity | None) -> str:
    if activity is None:
        return "rest"
    async with asyncio.timeout(ENDS_WITHIN_S):
        return await activity


def _expect_safe(charger: Charger, row: Row, fault: FaultCase) -> None:
    truth = charger.garage.world.truth()
    assert truth.lateral_violation_mm < LATERAL_MM, f"sideways in the socket: {row}"
    assert row.outcome != "internal", f"no reason that anybody could act on: {row}"
    if fault.harmless:
        assert row.outcome in {"done", "rest"}, f"a bad cable should only cost time: {row}"
    if row.outcome not in {"done", "rest", *STOPPED_BY_FORCE}:
        assert row.codes, f"neither a fault was latched nor the link was told lost: {row}"
    if truth.insertion_depth_mm > 1.0:
        assert row.plug in {PlugState.INSERTED, PlugState.UNKNOWN}, f"it is in the socket: {row}"


async def _come_back(charger: Charger) -> None:
    """As the documentation says: release the fault, then unplug or home."""
    services, supervisor = charger.services, charger.services.supervisor
    await eventually(lambda: supervisor.mode is not RobotMode.OFFLINE, within_s=LINK_WITHIN_S)
    if supervisor.mode in {RobotMode.FAULT, RobotMode.EMERGENCY_STOP, RobotMode.STOPPED}:
        await supervisor.reset()
    assert supervisor.fault is None
    if plug_of(services) in {PlugState.INSERTED, PlugState.UNKNOWN}:
        job = await do_job(services, JobType.UNPLUG)
        assert job.state is JobState.SUCCEEDED, job.error
    else:
        async with supervisor.control("homing", "A person") as lease:
            await supervisor.enable(lease)
            await supervisor.home(lease)
    truth, state = charger.garage.world.truth(), supervisor.telemetry.require()
    assert supervisor.mode is RobotMode.READY
    assert state.homed
    assert not truth.seated
    assert truth.insertion_depth_mm < 0
    assert truth.lateral_violation_mm < LATERAL_MM
    assert plug_of(services) in {PlugState.FREE, PlugState.PARKED}
