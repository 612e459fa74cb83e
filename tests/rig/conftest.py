from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Callable, Mapping
from pathlib import Path

import pytest
import pytest_asyncio

from drivers.arduino.driver import ArduinoRobot
from tests.rig.build import Programs, build_programs, missing_packages
from tests.rig.loop import LockStepLoop
from tests.rig.rig import Rig, running_rig


def pytest_asyncio_loop_factories() -> Mapping[str, Callable[[], asyncio.AbstractEventLoop]]:
    """Simulated time for all tests here but those in ``device``."""
    return {"lock step": LockStepLoop}


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """What takes minutes runs only if it is named on the command line."""
    is_long = collection_path.name == "campaign" and collection_path.is_dir()
    return True if is_long and not any("rig/campaign" in name for name in config.args) else None


@pytest.fixture(scope="session")
def programs() -> Programs:
    """Firmware and simulator, built from the sources."""
    missing = missing_packages()
    if missing:
        pytest.skip(f"the rig needs packages of the system: {' '.join(missing)}")
    return build_programs()


@pytest_asyncio.fixture(scope="module", loop_scope="module")
async def homed(programs: Programs) -> AsyncIterator[tuple[Rig, ArduinoRobot]]:
    """A rig whose robot was homed once for all tests of a file; each leaves it whole."""
    async with running_rig(programs) as rig:
        robot = rig.robot()
        await robot.connect()
        await robot.enable()
        await robot.home()
        yield rig, robot
        await robot.close()
