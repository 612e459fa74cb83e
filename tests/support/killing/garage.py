"""The garage that outlives its servers, and what a power cut does to it."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import AsyncIterator, Awaitable, Callable
from pathlib import Path
from typing import Any

from sqlalchemy.orm import Session

from drivers.registry import Devices
from drivers.simulator.garage import SimulatedGarage, build_garage
from drivers.simulator.parameters import SimulationParameters
from drivers.simulator.truth import GroundTruth
from server import composition
from server.config.recordings import RecordingSettings
from server.config.settings import Settings
from server.config.simulation import SimulationSettings
from server.jobs.approach import parking_joints
from server.services import Services
from server.storage.database import Database
from server.storage.errors import StorageError
from tests.support.killing.cords import Cord, CordedCamera, CordedRobot, CordedStation
from tests.support.killing.power import cut_power
from tests.support.knowing_eye import knowing_from_the_start

Scenario = Callable[[Services], Awaitable[None]]


class Killed(Exception):  # noqa: N818 - it is no error
    """The server was killed."""


class ImmortalGarage:
    """One garage and the data folder of the servers that come and go in it.

    Args:
        folder: Where they keep their data.
        seed: Of the garage.
    """

    def __init__(self, folder: Path, seed: int) -> None:
        simulation = SimulationSettings(seed=seed, parameters=_parameters())
        self.settings = Settings(simulation=simulation, recordings=RecordingSettings(enabled=False))
        self.garage: SimulatedGarage = build_garage(
            self.settings.geometry,
            self.settings.motion,
            self.settings.camera.mount,
            self.settings.camera.optics,
            simulation.parameters,
            seed=seed,
        )
        self._folder = folder
        self._cord = Cord()
        self._killed = asyncio.Event()

    @property
    def dead(self) -> bool:
        """The newest server has been killed."""
        return self._killed.is_set()

    def truth(self) -> GroundTruth:
        """What is really so, now."""
        return self.garage.world.truth(asyncio.get_running_loop().time())

    def kill(self) -> None:
        """The server stops at this very instant; the board notices the silence by itself."""
        self._cord.cut = True
        self._killed.set()
        self.garage.robot.unplug_link()

    async def live(self, scenario: Scenario) -> None:
        """One life of a server: until the scenario has ended, or until ``kill``.

        Raises:
            Killed: it did not live to the end.
        """
        self._cord, self._killed = Cord(), asyncio.Event()
        self.garage.robot.replug_link()
        life = asyncio.create_task(self._serve(scenario))
        death = asyncio.create_task(self._killed.wait())
        await asyncio.wait({life, death}, return_when=asyncio.FIRST_COMPLETED)
        if self.dead:
            life.cancel()
            await asyncio.gather(life, return_exceptions=True)
            raise Killed
        death.cancel()
        await life

    async def _serve(self, scenario: Scenario) -> None:
        cord, garage = self._cord, self.garage
        devices = Devices(
            robot=CordedRobot(garage.robot, cord),
            camera=CordedCamera(garage.camera, cord),
            station=CordedStation(garage.station, cord),
            garage=garage,
        )
        with knowing_from_the_start(garage.world):
            async with composition.running(
                self.settings, folder=self._folder, devices=devices
            ) as services:
                cord_database(services.database, cord)
                await scenario(services)

    def on_write(self, database: Database, kill_at: Callable[[int, str], bool]) -> None:
        """Kill the server at a piece of work for the database.

        Args:
            database: Of the server.
            kill_at: Asked before and after each piece, with its number from 1.
        """
        run = database.run
        count = 0

        async def counted(work: Callable[[Session], Any]) -> Any:  # noqa: ANN401
            nonlocal count
            count += 1
            number = count
            await self._die_if(kill_at(number, "before"))
            result = await run(work)
            await self._die_if(kill_at(number, "after"))
            return result

        database.run = counted  # type: ignore[method-assign]  # a test's own database

    async def _die_if(self, now: bool) -> None:
        if now and not self.dead:
            self.kill()
        if self.dead:
            raise StorageError("This server is dead.")

    def cut_power(self) -> None:
        """The whole house is dark for a moment."""
        cut_power(self.garage, asyncio.get_running_loop().time())


def cord_database(database: Database, cord: Cord) -> None:
    """Let nothing be written any more once the cord is cut."""
    in_order = database.in_order

    async def corded(call: Callable[[], Any]) -> Any:  # noqa: ANN401
        if cord.cut and call != database._close:
            raise StorageError("This server is dead.")
        return await in_order(call)

    # transactions, and the plug's own file beside them
    database.in_order = corded  # type: ignore[method-assign]  # a test's own database


def _parameters() -> SimulationParameters:
    """A machine without errors that wakes up homed in its parking place."""
    perfect = SimulationParameters.perfect()
    defaults = Settings()
    board = perfect.board.model_copy(
        update={
            "start_homed": True,
            "start_joints": parking_joints(defaults.geometry, defaults.park),
        }
    )
    return perfect.model_copy(update={"board": board})


@contextlib.asynccontextmanager
async def patience(limit_s: float) -> AsyncIterator[None]:
    """Virtual time after which a scenario is given up."""
    async with asyncio.timeout(limit_s):
        yield
