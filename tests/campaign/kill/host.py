"""The garage of the campaign: lives in a thread, in step with whichever server is alive."""

from __future__ import annotations

import asyncio
import contextlib
import math
import os
import queue
import signal
import socket
import threading
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from drivers.camera import Frame
from drivers.robot import BoardRefusedError, RobotState
from drivers.simulator.garage import SimulatedGarage, build_garage
from drivers.simulator.truth import GroundTruth
from drivers.station import StationSnapshot
from server.config.settings import Settings
from server.timing import VirtualTimeLoop
from tests.campaign.kill.wire import Answer, Call, Tick, Tock, receive, send
from tests.support.killing.power import cut_power

ACCEPT_S = 0.1


@dataclass(frozen=True, slots=True)
class Death:
    """How the next life of a server ends.

    Attributes:
        after_s: So long after it has reached the garage, in simulated time; None: not by the host.
        dark: It is a power cut of the whole house.
        absent_s: How long nobody drives the garage afterwards.
    """

    after_s: float | None
    dark: bool
    absent_s: float


NOBODY_DIES = Death(None, dark=False, absent_s=0.5)


class GarageHost:
    """Runs a garage, kills servers, and knows the truth.

    Args:
        settings: Of the garage.
        path: Where its socket appears.
    """

    def __init__(self, settings: Settings, path: Path) -> None:
        self.pid: int | None = None
        self.death = NOBODY_DIES
        self._settings = settings
        self._listener = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        self._listener.bind(str(path))
        self._listener.listen(1)
        self._listener.settimeout(ACCEPT_S)
        self._line: socket.socket | None = None
        self._ended = False
        self._asked: queue.Queue[Callable[[], None]] = queue.Queue()
        self._granted_s = 0.0
        self._offset_s = 0.0
        self._born_s = 0.0
        self._samples: list[RobotState] = []
        self._answers: list[Answer] = []
        self._tasks: set[asyncio.Task[None]] = set()
        self._ready = threading.Event()
        self._thread = threading.Thread(target=self._run, name="garage", daemon=True)

    def start(self) -> None:
        """Let the garage begin."""
        self._thread.start()
        self._ready.wait()

    def close(self) -> None:
        """End it."""
        self._ended = True
        self._thread.join()
        self._listener.close()

    def do(self, action: Callable[[SimulatedGarage], Any]) -> Any:  # noqa: ANN401
        """Do something in the garage's own thread and return what comes of it."""
        result: queue.Queue[Any] = queue.Queue()
        self._asked.put(lambda: result.put(action(self.garage)))
        return result.get(timeout=60.0)

    def truth(self) -> GroundTruth:
        """What is really so."""
        truth = self.do(lambda garage: garage.world.truth())
        assert isinstance(truth, GroundTruth)
        return truth

    # The garage's thread

    def _run(self) -> None:
        with asyncio.Runner(loop_factory=lambda: VirtualTimeLoop(self._pass_time)) as runner:
            self._loop = runner.get_loop()
            with contextlib.suppress(_Ended):
                runner.run(self._live())

    async def _live(self) -> None:
        settings = self._settings
        self.garage = build_garage(
            settings.geometry,
            settings.motion,
            settings.camera.mount,
            settings.camera.optics,
            settings.simulation.parameters,
            seed=settings.simulation.seed,
        )
        self._ready.set()
        await asyncio.Event().wait()

    def _pass_time(self, now_s: float, until_s: float | None) -> float:
        """Everybody in the garage waits: go on as far as the server has come."""
        while self._granted_s <= now_s:
            if self._ended:
                raise _Ended
            self._obey()
            if self._line is None:
                self._accept(now_s)
            elif self._exchange(self._line, now_s):
                return now_s  # calls have come in
        return min(self._granted_s, math.inf if until_s is None else until_s)

    def _obey(self) -> None:
        with contextlib.suppress(queue.Empty):
            while True:
                self._asked.get_nowait()()

    def _accept(self, now_s: float) -> None:
        try:
            self._line, _ = self._listener.accept()
            self._line.settimeout(None)
            tick = receive(self._line)
        except TimeoutError:
            return
        except EOFError:
            self._line = None
            return
        self._offset_s, self._born_s = now_s - tick.now_s, now_s
        self._loop.call_soon(self.garage.robot.replug_link)
        self._take(tick)

    def _exchange(self, line: socket.socket, now_s: float) -> bool:
        """Tell what has happened and hear how far the server has come."""
        self._kill_if_due(now_s)
        samples, self._samples = self._samples, []
        answers, self._answers = self._answers, []
        try:
            send(line, Tock(samples, answers))
            tick = receive(line)
        except (EOFError, OSError):
            self._lose(line, now_s)
            return True
        return self._take(tick)

    def _take(self, tick: Tick) -> bool:
        self._granted_s = max(self._granted_s, tick.now_s + self._offset_s)
        for call in tick.calls:
            self._loop.call_soon(self._begin, call)
        return bool(tick.calls)

    def _kill_if_due(self, now_s: float) -> None:
        after_s = self.death.after_s
        if after_s is not None and now_s >= self._born_s + after_s and self.pid is not None:
            os.kill(self.pid, signal.SIGKILL)
            self.pid = None

    def _lose(self, line: socket.socket, now_s: float) -> None:
        """The server is dead. The board will notice; the house may be dark."""
        line.close()
        self._line = None
        for task in self._tasks:
            task.cancel()
        self._samples, self._answers = [], []
        self._loop.call_soon(self.garage.robot.unplug_link)
        if self.death.dark:
            self._loop.call_soon(cut_power, self.garage, now_s)
        self._granted_s = now_s + self.death.absent_s

    def _begin(self, call: Call) -> None:
        task = self._loop.create_task(self._carry_out(call))
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    async def _carry_out(self, call: Call) -> None:
        device = getattr(self.garage, call.device)
        arguments = dict(call.arguments)
        if isinstance(exposed_after_s := arguments.get("exposed_after_s"), float):
            arguments["exposed_after_s"] = exposed_after_s + self._offset_s
        try:
            value = await getattr(device, call.method)(**arguments)
        except Exception as error:  # noqa: BLE001 - raised again at the other end
            words: tuple[str, ...] = (str(error),)
            if isinstance(error, BoardRefusedError):
                words = (str(error), error.reason)
            self._answers.append(Answer(call.number, None, (type(error), words)))
            return
        self._answers.append(Answer(call.number, self._on_its_clock(value), None))
        if (call.device, call.method) == ("robot", "connect"):
            await self._forward_samples()

    async def _forward_samples(self) -> None:
        async for state in self.garage.robot.telemetry():
            self._samples.append(self._on_its_clock(state))

    def _on_its_clock(self, value: Any) -> Any:  # noqa: ANN401 - whatever a driver returns
        """The same with the times of the server's clock."""
        shift_s = -self._offset_s
        match value:
            case RobotState():
                return replace(
                    value,
                    sampled_at_s=value.sampled_at_s + shift_s,
                    received_at_s=value.received_at_s + shift_s,
                )
            case StationSnapshot():
                return replace(value, sampled_at_s=value.sampled_at_s + shift_s)
            case Frame():
                return replace(value, captured_at_s=value.captured_at_s + shift_s)
            case _:
                return value


class _Ended(Exception):  # noqa: N818 - it is no error
    """The campaign is over."""
