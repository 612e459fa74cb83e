"""From where a browser first looks at the picture."""

from __future__ import annotations

import math

import viser

from twin.geometry import RobotGeometry
from twin.scene.frames import metres
from twin.scene.poses import region_center

_FROM_MM = (-970.0, 690.0, -1560.0)
"""Behind the wall, which is not drawn from there, and to the left: nothing hides the plug."""
_AT_MM = (10.0, -140.0, -190.0)
_FIELD_OF_VIEW_RAD = math.radians(46.0)


def set_first_view(server: viser.ViserServer, geometry: RobotGeometry) -> None:
    """Looks at the regular box from its back left, so that robot, plug and car are seen."""
    x, y, z = region_center(geometry)
    camera = server.initial_camera
    camera.position = metres((x + _FROM_MM[0], y + _FROM_MM[1], z + _FROM_MM[2]))
    camera.look_at = metres((x + _AT_MM[0], y + _AT_MM[1], z + _AT_MM[2]))
    camera.fov = _FIELD_OF_VIEW_RAD
    camera.near = 0.02
    camera.far = 30.0
