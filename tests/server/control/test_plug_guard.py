from __future__ import annotations

import asyncio
from pathlib import Path

import pytest
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, rule

from server.control.errors import LateralMotionForbiddenError
from server.control.model import PlugState
from server.control.plug_guard import Corridor, PlugGuard, PlugRecord
from server.storage.database import Database
from server.storage.errors import StorageError
from server.storage.plug import StoredPlug
from tests.support.robot_cell import MemoryPlug, RobotCell, in_cell, parameters
from tests.support.virtual import run_virtual
from twin.joints import JointPosition

AT = JointPosition(150.0, 160.0, 55.0)
CORRIDOR = Corridor(150.0, 160.0, 55.0, 75.0, 115.0)
HELD = {PlugState.INSERTED, PlugState.UNKNOWN}


class AnySequenceOfCalls(RuleBasedStateMachine):
    """Whatever is called in whatever order: a plug that may be in a socket goes only out."""

    @initialize(inserted=st.booleans())
    def power_up(self, inserted: bool) -> None:
        record = PlugRecord(PlugState.INSERTED, CORRIDOR) if inserted else None
        self.store = MemoryPlug(record)
        self.joints = AT
        self.held_at: JointPosition | None = None
        self.restart()

    @rule()
    def restart(self) -> None:
        self.store.failure = None
        self.guard = PlugGuard(self.store, lambda: None)
        asyncio.run(self.guard.recover())
        self.entering = False
        self.held_at = None  # the guard cannot know what happened before

    @rule(fails=st.booleans())
    def disk(self, fails: bool) -> None:
        self.store.failure = StorageError("The disk is full.") if fails else None

    @rule(what=st.sampled_from(["doubt", "is_free", "is_parked", "about_to_leave_park"]))
    def declare(self, what: str) -> None:
        self.written(getattr(self.guard, what)())

    @rule()
    def enter(self) -> None:
        self.entering = self.written(
            self.guard.about_to_enter(
                Corridor(self.joints.rho1_mm, self.joints.rho2_mm, 55.0, 75.0, 115.0)
            )
        )

    def written(self, call: object) -> bool:
        try:
            asyncio.run(call)  # type: ignore[arg-type]  # any coroutine of the guard
        except StorageError:
            return False
        return True

    @rule(
        sideways=st.sampled_from([0.0, 0.0, 1e-9, 0.04, -0.04, 0.3, -5.0]),
        along=st.sampled_from([-30.0, -5.0, -0.04, 0.0, 0.04, 0.4, 10.0, 60.0]),
        carriage=st.sampled_from([0, 1]),
        times=st.sampled_from([1, 1, 4]),
    )
    def move(self, sideways: float, along: float, carriage: int, times: int) -> None:
        """The same motion, also several times in a row."""
        for _ in range(times):
            self.move_once(sideways, along, carriage)

    def move_once(self, sideways: float, along: float, carriage: int) -> None:
        target = list(self.joints)
        target[carriage] += sideways
        target[2] += along
        end = JointPosition(*target)
        middle = JointPosition(*((a + b) / 2 for a, b in zip(self.joints, end, strict=True)))
        try:
            self.guard.check(self.joints, [middle, end])
        except LateralMotionForbiddenError:
            assert self.guard.state in HELD
            if sideways == 0.0 and along <= 0.0:
                raise AssertionError("the way out must always be open") from None
            return
        if self.entering:
            self.entering = False
            if self.held_at is not None:
                self.held_at = self.held_at._replace(rho3_mm=end.rho3_mm)
            deepest_mm = max(115.0, self.joints.rho3_mm)
            assert end.rho3_mm <= deepest_mm + 0.0501, "no deeper than the socket"
        self.joints = end
        self.guard.motion_ended()

    @invariant()
    def nothing_has_gone_sideways_or_further_in(self) -> None:
        if self.guard.state not in HELD:
            self.held_at = None
            return
        if self.held_at is None:
            self.held_at = self.joints
        if self.joints.rho3_mm < self.held_at.rho3_mm:
            self.held_at = self.held_at._replace(rho3_mm=self.joints.rho3_mm)
        # one tolerance in all, not one for every motion
        assert abs(self.joints.rho1_mm - self.held_at.rho1_mm) <= 0.0501
        assert abs(self.joints.rho2_mm - self.held_at.rho2_mm) <= 0.0501
        assert self.joints.rho3_mm - self.held_at.rho3_mm <= 0.0501

    @invariant()
    def the_disk_is_never_more_optimistic_than_the_guard(self) -> None:
        on_disk = self.store.records[-1].state if self.store.records else PlugState.FREE
        if self.guard.state in HELD and self.store.failure is None and on_disk not in HELD:
            # a failed write: the motion that it was for has not begun
            assert not self.entering


TestAnySequenceOfCalls = AnySequenceOfCalls.TestCase
TestAnySequenceOfCalls.settings = settings(
    max_examples=60, stateful_step_count=25, deadline=None, derandomize=True
)


@pytest.mark.parametrize("state", list(PlugState))
def test_the_record_survives_a_reopened_database(tmp_path: Path, state: PlugState) -> None:
    async def write() -> None:
        database = Database(tmp_path)
        await database.open()
        await StoredPlug(database).save(PlugRecord(PlugState.FREE, None))
        corridor = CORRIDOR if state is PlugState.INSERTED else None
        await StoredPlug(database).save(PlugRecord(state, corridor))
        await database.close()

    async def read() -> PlugGuard:
        database = Database(tmp_path)
        await database.open()
        guard = PlugGuard(StoredPlug(database), lambda: None)
        await guard.recover()
        await database.close()
        return guard

    run_virtual(write())
    guard = run_virtual(read())
    assert guard.state is state
    assert guard.corridor == (CORRIDOR if state is PlugState.INSERTED else None)


def test_a_new_installation_has_a_free_plug(tmp_path: Path) -> None:
    async def scenario() -> PlugState:
        database = Database(tmp_path)
        await database.open()
        guard = PlugGuard(StoredPlug(database), lambda: None)
        assert guard.state is PlugState.UNKNOWN, "before anything was read"
        await guard.recover()
        await database.close()
        return guard.state

    assert run_virtual(scenario()) is PlugState.FREE


def test_a_cancelled_write_is_finished_and_memory_agrees_with_the_disk() -> None:
    async def scenario() -> None:
        store = MemoryPlug()

        async def slow_disk(_record: PlugRecord) -> None:
            await asyncio.sleep(0.1)

        store.saving = slow_disk
        guard = PlugGuard(store, lambda: None)
        await guard.recover()
        entering = asyncio.create_task(guard.about_to_enter(CORRIDOR))
        await asyncio.sleep(0.05)
        assert guard.state is PlugState.INSERTED, "what forbids counts at once"
        assert not store.records
        entering.cancel()
        with pytest.raises(asyncio.CancelledError):
            await entering
        assert store.records == [PlugRecord(PlugState.INSERTED, CORRIDOR)]
        freeing = asyncio.create_task(guard.is_free())
        await asyncio.sleep(0.05)
        assert guard.state is PlugState.INSERTED, "what allows counts when it is on disk"
        await freeing
        assert [guard.state] == [PlugState.FREE]

    run_virtual(scenario())


def test_the_record_is_on_disk_before_the_robot_leaves_its_parking_place() -> None:
    async def scenario(cell: RobotCell) -> None:
        moving_when_written: list[bool] = []

        async def slow_disk(_record: PlugRecord) -> None:
            await asyncio.sleep(0.2)
            moving_when_written.append(cell.moving())

        cell.store.saving = slow_disk
        await cell.supervisor.plug.is_parked()
        async with cell.supervisor.control("job", "Test") as lease:
            await cell.supervisor.move_joints(lease, AT)
        assert [record.state for record in cell.store.records] == [
            PlugState.PARKED,
            PlugState.FREE,
        ]
        assert moving_when_written == [False, False]

    in_cell(scenario)


def test_a_disk_that_fails_keeps_the_robot_in_its_parking_place() -> None:
    async def scenario(cell: RobotCell) -> None:
        await cell.supervisor.plug.is_parked()
        here = cell.now
        cell.store.failure = StorageError("The disk is full.")
        async with cell.supervisor.control("job", "Test") as lease:
            with pytest.raises(StorageError):
                await cell.supervisor.move_joints(lease, AT)
            with pytest.raises(StorageError):
                await cell.supervisor.home(lease)
        assert cell.now == here

    in_cell(scenario)


@pytest.mark.parametrize("state", sorted(HELD))
def test_with_a_held_plug_only_the_way_out_is_open(state: PlugState) -> None:
    async def scenario(cell: RobotCell) -> None:
        supervisor = cell.supervisor
        async with supervisor.control("job", "Test") as lease, supervisor.plug_may_move():
            here = cell.robot.commanded.position
            for target in (
                here._replace(rho1_mm=here.rho1_mm + 1.0),
                here._replace(rho2_mm=here.rho2_mm - 1.0),
                here._replace(rho3_mm=here.rho3_mm + 1.0),
                here._replace(rho1_mm=here.rho1_mm + 0.2, rho3_mm=60.0),
            ):
                with pytest.raises(LateralMotionForbiddenError):
                    await supervisor.move_joints(lease, target)
            with pytest.raises(LateralMotionForbiddenError):
                await supervisor.home(lease)
            assert cell.now == pytest.approx(here, abs=0.02)
            await supervisor.move_joints(lease, here._replace(rho3_mm=60.0))
            await supervisor.plug.is_free()
            await supervisor.move_joints(lease, here._replace(rho1_mm=170.0, rho3_mm=60.0))

    record = PlugRecord(state, CORRIDOR if state is PlugState.INSERTED else None)
    numbers = parameters(start_joints=AT._replace(rho3_mm=100.0))
    in_cell(scenario, numbers, store=MemoryPlug(record))


def test_the_permission_to_go_in_ends_with_one_motion() -> None:
    async def scenario(cell: RobotCell) -> None:
        supervisor = cell.supervisor
        async with supervisor.control("job", "Test") as lease, supervisor.load.watching():
            await supervisor.plug.about_to_enter(CORRIDOR)
            with pytest.raises(LateralMotionForbiddenError, match="further in"):
                await supervisor.move_joints(lease, AT._replace(rho3_mm=116.0))
            await supervisor.move_joints(lease, AT._replace(rho3_mm=70.0))
            with pytest.raises(LateralMotionForbiddenError, match="further in"):
                await supervisor.move_joints(lease, AT._replace(rho3_mm=71.0))
            await supervisor.move_joints(lease, AT._replace(rho3_mm=65.0))
            with pytest.raises(LateralMotionForbiddenError, match="further in"):
                await supervisor.move_joints(lease, AT._replace(rho3_mm=70.0))

    in_cell(scenario, parameters(start_joints=AT))
