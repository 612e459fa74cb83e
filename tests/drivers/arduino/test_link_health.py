"""What the driver tells about its link: every trouble is counted once, and nothing else is."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from dataclasses import replace

import pytest

from drivers.arduino.driver import ArduinoRobot
from drivers.arduino.link.clock import KEPT_ANSWERS
from drivers.arduino.link.frames import FrameReader
from drivers.arduino.protocol.messages import FROM_BOARD, TICK_HZ
from drivers.arduino.serial_port import OnFrames, OnLost
from drivers.arduino.settings import BoardSettings
from drivers.arduino.telemetry import NOT_MEASURED_DC, supply_v, temperature_degc
from drivers.robot.link_health import LinkHealth, RoundTrip, TellsLinkHealth
from tests.drivers.arduino.driving import GEOMETRY, LIMITS
from tests.support.fake_board import FakeBoard
from tests.support.virtual import run_virtual, wait_until

STEP_S = 0.001
DELAY_S = 0.0015


def spoiled(data: bytes) -> bytes:
    """One bit before the delimiter has turned, in such a way that no second delimiter arises."""
    return data[:-2] + bytes([data[-2] ^ (0x40 if data[-2] != 0x40 else 0x20)]) + data[-1:]


class SlowLine:
    """A line to a fake board in the loop's own time; its delay and its damage are known.

    Attributes:
        spoil_to_host: How many of the next pieces to the host arrive damaged.
        spoil_to_board: How many of the next pieces to the board do.
        delay_s: One way.
    """

    def __init__(self, on_frames: OnFrames, on_lost: OnLost) -> None:
        self.spoil_to_host = self.spoil_to_board = 0
        self.delay_s = DELAY_S
        self._on_frames, self._on_lost = on_frames, on_lost
        self._frames = FrameReader(FROM_BOARD)
        self._loop = asyncio.get_running_loop()
        self._board = FakeBoard(self._say)
        self._living = self._loop.create_task(self._live())

    @property
    def damaged(self) -> int:
        """Frames that arrived damaged."""
        return self._frames.damaged

    def write(self, data: bytes) -> None:
        """Bytes of the host."""
        if self.spoil_to_board:
            self.spoil_to_board -= 1
            data = spoiled(data)
        self._loop.call_later(self.delay_s, self._board.hear, data)

    def pull(self) -> None:
        """The port is gone."""
        self._living.cancel()
        self._on_lost("The cable was pulled.")

    async def close(self) -> None:
        """Pull the cable."""
        self._living.cancel()
        await asyncio.gather(self._living, return_exceptions=True)

    def _say(self, data: bytes) -> None:
        if self.spoil_to_host:
            self.spoil_to_host -= 1
            data = spoiled(data)
        self._loop.call_later(self.delay_s, self._arrive, data)

    def _arrive(self, data: bytes) -> None:
        self._on_frames(list(self._frames.feed(data)), self._loop.time())

    async def _live(self) -> None:
        began_s = self._loop.time()
        while True:
            self._board.advance(int((self._loop.time() - began_s) * TICK_HZ))
            await asyncio.sleep(STEP_S)


Scenario = Callable[[ArduinoRobot, list[SlowLine]], Awaitable[None]]


def on_lines(scenario: Scenario) -> None:
    """A robot that is connected; the last line is the open one."""
    lines: list[SlowLine] = []

    async def open_line(device: str, on_frames: OnFrames, on_lost: OnLost) -> SlowLine:
        del device
        lines.append(SlowLine(on_frames, on_lost))
        lines[-1].spoil_to_host = 2  # as while a boot loader speaks
        return lines[-1]

    async def main() -> None:
        robot = ArduinoRobot("ttyBoard", GEOMETRY, LIMITS, BoardSettings(), open_line=open_line)
        assert robot.link_health() == LinkHealth(reconnections=0)
        await robot.connect()
        await scenario(robot, lines)
        await robot.close()
        assert robot.link_health().received is None

    run_virtual(main())


def test_a_good_link_has_its_times_and_no_trouble() -> None:
    async def scenario(robot: ArduinoRobot, _: list[SlowLine]) -> None:
        assert isinstance(robot, TellsLinkHealth)
        await robot.enable()
        await asyncio.sleep(2 * KEPT_ANSWERS)
        health = robot.link_health()
        assert health.round_trip is not None
        assert health.round_trip.answers == KEPT_ANSWERS
        for took_s in (health.round_trip.newest_s, health.round_trip.median_s):
            assert took_s == pytest.approx(2 * DELAY_S, abs=1e-6)
        troubles = (health.damaged, health.damaged_at_board, health.sent_again)
        assert troubles == (0, 0, 0), "what came before the board's introduction is no damage"
        assert health.reconnections == 0
        assert health.received is not None
        assert health.received > 2 * KEPT_ANSWERS * 10, "ten samples a second, and answers"
        assert (health.supply_v, health.temperature_degc) == (12.0, 25.1)

    on_lines(scenario)


def test_frames_that_come_damaged_are_counted_at_either_end() -> None:
    async def scenario(robot: ArduinoRobot, lines: list[SlowLine]) -> None:
        (line,) = lines
        line.spoil_to_host = 3
        await wait_until(lambda: line.spoil_to_host == 0)
        await asyncio.sleep(0.5)
        assert (robot.link_health().damaged, robot.link_health().damaged_at_board) == (3, 0)
        line.spoil_to_board = 4  # heartbeats and questions for the time
        await wait_until(lambda: line.spoil_to_board == 0)
        await asyncio.sleep(0.5)
        health = robot.link_health()
        assert (health.damaged, health.damaged_at_board) == (3, 4)
        assert health.sent_again == 0, "nothing of that wants an acknowledgement"

    on_lines(scenario)


def test_a_command_that_was_lost_is_sent_again_and_counted() -> None:
    async def scenario(robot: ArduinoRobot, lines: list[SlowLine]) -> None:
        lines[-1].spoil_to_board = 1
        await robot.enable()
        assert robot.link_health().sent_again == 1

    on_lines(scenario)


def test_a_line_that_becomes_slow_shows_in_its_times() -> None:
    async def scenario(robot: ArduinoRobot, lines: list[SlowLine]) -> None:
        await asyncio.sleep(5.0)
        lines[-1].delay_s = 0.04
        await asyncio.sleep(2.5)
        times = robot.link_health().round_trip
        assert times is not None
        assert times.newest_s == times.worst_s == pytest.approx(0.08)
        assert times.median_s == pytest.approx(2 * DELAY_S)

    on_lines(scenario)


def test_counters_begin_anew_with_a_new_link_and_new_links_are_counted() -> None:
    async def scenario(robot: ArduinoRobot, lines: list[SlowLine]) -> None:
        lines[-1].spoil_to_host = 2
        await wait_until(lambda: robot.link_health().damaged == 2)
        for number in (1, 2):
            lines[-1].pull()
            await asyncio.sleep(0)
            assert robot.link_health() == LinkHealth(reconnections=number - 1)
            await robot.connect()
            health = robot.link_health()
            assert (health.damaged, health.reconnections) == (0, number)

    on_lines(scenario)


def test_the_boards_own_count_may_wrap() -> None:
    async def scenario(robot: ArduinoRobot, lines: list[SlowLine]) -> None:
        line = lines[-1]
        for _ in range(3):
            line._board._frames.damaged += 200
            await asyncio.sleep(0.3)
        assert robot.link_health().damaged_at_board == 600

    on_lines(scenario)


def test_what_the_board_has_not_measured_is_not_known() -> None:
    measured = FakeBoard(lambda _: None)._telemetry()
    assert (supply_v(measured), temperature_degc(measured)) == (12.0, 25.1)
    unknown = replace(measured, supply_mv=0, temperature_dc=NOT_MEASURED_DC)
    assert (supply_v(unknown), temperature_degc(unknown)) == (None, None)


def test_no_answer_is_no_time() -> None:
    assert RoundTrip.of([]) is None
    assert RoundTrip.of([0.004, 0.002, 0.001]) == RoundTrip(0.001, 0.002, 0.004, 3)
