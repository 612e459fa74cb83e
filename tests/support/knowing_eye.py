"""An eye that knows where the socket is: for tests that are not about seeing.

Without pictures a job takes a tenth of its computing time.
"""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import Awaitable, Callable, Iterator
from pathlib import Path
from typing import Any, TypeVar
from unittest.mock import patch

import numpy as np
from numpy.typing import NDArray

from drivers.simulator.world import SimulatedWorld
from server.config.settings import Settings
from server.localisation.eye import Eye
from server.localisation.socket_pose import SocketPose
from server.schema.vehicles import Vehicle
from server.services import Services
from tests.support.garage import Scene, on_scene
from twin.kinematics import gamma

T = TypeVar("T")

PICTURE_S = 0.05
SIGMA_MM = 0.02


class KnowingEye(Eye):
    """Takes as long as a camera would, and is as right as a good one.

    Args:
        eye: Whose place it takes.
        world: Knows where the socket is.

    Attributes:
        error_mm: It sees the socket so far away from where it is, in the base frame, shape (3,).
    """

    def __init__(self, eye: Eye, world: SimulatedWorld) -> None:
        super().__init__(eye._camera, eye.known, eye._geometry, eye._telemetry)
        self.error_mm: NDArray[np.float64] = np.zeros(3)
        self._world = world
        self._chance = np.random.default_rng(0)

    async def look(self, vehicle: Vehicle, expected: SocketPose | None = None) -> SocketPose | None:
        del vehicle
        return await self._see(PICTURE_S, still=expected is None)

    async def measure(
        self, vehicle: Vehicle, frames: int, expected: SocketPose | None
    ) -> SocketPose | None:
        del vehicle, expected
        return await self._see(PICTURE_S * frames, still=True)

    async def _see(self, duration_s: float, *, still: bool) -> SocketPose:
        await asyncio.sleep(duration_s)
        now_s = asyncio.get_running_loop().time()
        car = self._world.car
        noise_mm = self._chance.normal(0.0, SIGMA_MM, 3)
        shift_mm = self._robots_error_mm(now_s) + self.error_mm + noise_mm
        T_base_socket, T_base_label = car.T_base_socket.copy(), car.T_base_label.copy()
        T_base_socket[:3, 3] += shift_mm
        T_base_label[:3, 3] += shift_mm
        return SocketPose(
            T_base_socket=T_base_socket,
            T_base_label=T_base_label,
            covariance=np.eye(3) * SIGMA_MM**2,
            measured_at_s=now_s,
            from_standstill=still,
        )

    def _robots_error_mm(self, now_s: float) -> NDArray[np.float64]:
        """Where the robot believes its plug to be, from where it is.

        A camera on the platform sees what lies before it, so sag and errors of the build drop out.
        """
        believed = gamma.forward(self._geometry, self._telemetry.joints_at(now_s))
        shift: NDArray[np.float64] = (
            np.array(believed) - self._world.truth(now_s).T_base_plug[:3, 3]
        )
        return shift


@contextlib.contextmanager
def knowing_from_the_start(world: SimulatedWorld) -> Iterator[None]:
    """Servers that are started in this block have an eye that knows.

    A job that goes on after a restart has looked before anybody could give it another eye.
    """

    def make(*parts: Any) -> KnowingEye:  # noqa: ANN401 - what an Eye is made of
        return KnowingEye(Eye(*parts), world)

    with patch("server.composition.Eye", make):
        yield


def let_it_know(services: Services) -> None:
    """Give the jobs of a simulated server an eye that knows."""
    assert services.garage is not None
    runner = services.runner
    runner._eye = KnowingEye(runner._eye, services.garage.world)


def on_knowing_scene(
    scenario: Callable[[Scene], Awaitable[T]],
    *,
    seed: int = 1,
    folder: Path | None = None,
    parked: bool = True,
    settings: Settings | None = None,
) -> T:
    """As ``on_scene``, for scenarios in which nothing depends on pictures."""

    async def knowing(scene: Scene) -> T:
        let_it_know(scene.services)
        return await scenario(scene)

    return on_scene(knowing, seed=seed, folder=folder, parked=parked, settings=settings)
