"""An eye that knows where the socket is, to within what a good one measures.

Recovery does not depend on pictures, and without them a job takes a tenth of its computing time.
"""

from __future__ import annotations

import asyncio

import numpy as np

from server.localisation.eye import Eye
from server.localisation.socket_pose import SocketPose
from server.schema.vehicles import Vehicle
from tests.support.killing.cords import CordedCamera

LOOK_S = 0.06
SIGMA_MM = 0.03


class IdealEye(Eye):
    """Takes the place of ``Eye`` at a ``CordedCamera``."""

    async def look(
        self,
        vehicle: Vehicle,  # noqa: ARG002 - there is only one
        expected: SocketPose | None = None,
    ) -> SocketPose | None:
        return await self._see(still=expected is None)

    async def measure(
        self,
        vehicle: Vehicle,  # noqa: ARG002 - there is only one
        frames: int,
        expected: SocketPose | None,  # noqa: ARG002 - it needs no help
    ) -> SocketPose | None:
        await asyncio.sleep(frames * LOOK_S)
        return await self._see(still=True)

    async def _see(self, *, still: bool) -> SocketPose:
        await asyncio.sleep(LOOK_S)
        assert isinstance(self._camera, CordedCamera)
        world = self._camera.world
        now_s = asyncio.get_running_loop().time()
        socket = world.car.T_base_socket.copy()
        socket[:3, 3] += world.streams.telemetry.normal(0.0, SIGMA_MM, 3)
        return SocketPose(
            T_base_socket=socket,
            T_base_label=world.car.T_base_label.copy(),
            covariance=np.eye(3) * SIGMA_MM**2,
            measured_at_s=now_s,
            from_standstill=still,
        )
