"""A motion as one file that the 3D client plays back with a scrub bar, without any server."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from twin.camera_mount import CameraMount
from twin.geometry import RobotGeometry
from twin.scene import viser_server
from twin.scene.camera_view import set_first_view
from twin.scene.scene import TwinScene
from twin.scene.state import TwinState
from twin.statics import ActuatorLimits, Loads, SagTables


@dataclass(frozen=True, slots=True)
class PlaybackFrame:
    """What the picture shows from a time on.

    Attributes:
        at_s: Seconds since the playback began; never less than the frame before.
        state: The robot, the plug and the car.
    """

    at_s: float
    state: TwinState


def build_playback(
    geometry: RobotGeometry,
    mount: CameraMount,
    *,
    hfov_rad: float,
    aspect: float,
    loads: Loads,
    limits: ActuatorLimits,
    sag: SagTables,
    frames: Iterable[PlaybackFrame],
) -> bytes:
    """The frames in the 3D library's own format (a .viser file).

    It is the live picture's own scene that is recorded, so a playback looks the same. The library
    records only what changes from frame to frame.

    Args:
        geometry: The robot as it was.
        mount: Where its camera sat.
        hfov_rad: The camera's horizontal field of view.
        aspect: Width of its picture divided by its height.
        loads: What it carried, and the largest forces at its plug.
        limits: What its actuators could hold.
        sag: The table of its sag at nine points.
        frames: In the order of time; the last one says how long the playback lasts.
    """
    server = viser_server.open_server()
    try:
        set_first_view(server, geometry)
        scene = TwinScene(
            server.scene,
            geometry,
            mount,
            hfov_rad=hfov_rad,
            aspect=aspect,
            loads=loads,
            limits=limits,
            sag=sag,
        )
        recording = server.get_scene_serializer()
        shown: TwinState | None = None
        now_s = 0.0
        for frame in frames:
            recording.insert_sleep(frame.at_s - now_s)
            now_s = frame.at_s
            if frame.state is not shown:
                scene.show(frame.state)
                shown = frame.state
            scene.animate(now_s)
        return recording.serialize()
    finally:
        server.stop()
