"""Can the plug holder follow the socket's tilt?"""

from __future__ import annotations

import math

from server.jobs.context import JobContext
from server.jobs.errors import SocketTooSkewedError
from server.localisation.socket_pose import SocketPose


def refuse_skewed(job: JobContext, socket: SocketPose) -> None:
    """Raise SocketTooSkewedError when the plug holder cannot follow the socket's tilt."""
    tilt_deg = math.degrees(socket.tilt_rad(job.supervisor.geometry))
    limit_deg = job.settings.insertion.max_tilt_deg
    if tilt_deg > limit_deg:
        raise SocketTooSkewedError(
            f"The socket is tilted by {tilt_deg:.1f} degrees; "
            f"the plug can follow {limit_deg:.1f} degrees.",
            tilt_deg=round(tilt_deg, 2),
            limit_deg=limit_deg,
        )
