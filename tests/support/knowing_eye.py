"""An eye that knows where the socket is: for tests that are not about seeing."""

from __future__ import annotations

import asyncio

import numpy as np
from numpy.typing import NDArray

from drivers.simulator.world import SimulatedWorld
from server.localisation.eye import Eye
from server.localisation.socket_pose import SocketPose
from server.schema.vehicles import Vehicle
from server.services import Services
from twin.kinematics import gamma

PICTURE_S = 0.05
SIGMA_MM = 0.02


class KnowingEye(Eye):
    """Takes as long as a camera would, and is right.

    Args:
        eye: Whose place it takes.
        world: Knows where the socket is.
    """

    def __init__(self, eye: Eye, world: SimulatedWorld) -> None:
        super().__init__(eye._camera, eye.optics, eye.mount, eye._geometry, eye._telemetry)
        self._world = world

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
        shift_mm = self._error_mm(now_s)
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

    def _error_mm(self, now_s: float) -> NDArray[np.float64]:
        """Where the robot believes its plug to be, from where it is.

        A camera on the platform sees what lies before it, so sag and errors of the build drop out.
        """
        believed = gamma.forward(self._geometry, self._telemetry.joints_at(now_s))
        shift: NDArray[np.float64] = (
            np.array(believed) - self._world.truth(now_s).T_base_plug[:3, 3]
        )
        return shift


def let_it_know(services: Services) -> None:
    """Give the jobs of a simulated server an eye that knows."""
    assert services.garage is not None
    runner = services.runner
    runner._eye = KnowingEye(runner._eye, services.garage.world)
