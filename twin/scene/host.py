"""Runs the 3D picture beside the server: starts it, feeds it, stops it."""

from __future__ import annotations

import logging
import threading
import time
from typing import TYPE_CHECKING

from twin.camera_mount import CameraMount
from twin.geometry import RobotGeometry
from twin.scene.state import TwinState
from twin.statics import ActuatorLimits, Loads, SagTables

if TYPE_CHECKING:
    import viser

    from twin.scene.scene import TwinScene

logger = logging.getLogger(__name__)

STEP_S = 1 / 30
_QUIET_STEP_S = 0.05
"""Longest wait for a new state: what moves by itself goes on."""
_IDLE_STEP_S = 0.25
_BEAT_S = 0.4
"""Every beat makes the browsers draw; a robot that stands still should not warm a phone."""
_HEARTBEATS = 64
_JOIN_S = 8.0


class TwinHost:
    """A 3D picture on a loopback port, updated 30 times a second while somebody watches.

    All methods may be called from any thread. `start` returns at once: loading the 3D library
    and building the picture takes about a second and happens in a thread of its own.
    """

    def __init__(
        self,
        geometry: RobotGeometry,
        mount: CameraMount,
        hfov_rad: float,
        aspect: float,
        *,
        loads: Loads | None = None,
        limits: ActuatorLimits | None = None,
        sag: SagTables | None = None,
    ) -> None:
        """Args as for the scene; nothing is loaded or opened yet.

        Args:
            geometry: The robot.
            mount: Where its camera sits.
            hfov_rad: The camera's horizontal field of view.
            aspect: Width of its picture divided by its height.
            loads: What the robot carries, its cable too, and the largest forces at the plug.
            limits: What its actuators can hold.
            sag: The table of the sag at nine points; for all three there are defaults.
        """
        self._geometry = geometry
        self._mount = mount
        self._hfov_rad = hfov_rad
        self._aspect = aspect
        self._loads = loads or Loads()
        self._limits = limits or ActuatorLimits()
        self._sag = sag or SagTables()
        self._newest: TwinState | None = None
        self._stop = threading.Event()
        self._changed = threading.Event()
        self._opened = threading.Event()
        self._thread: threading.Thread | None = None
        self._port: int | None = None
        self._watching = 0

    @property
    def ready(self) -> bool:
        """Whether browsers can be connected."""
        return self._opened.is_set()

    @property
    def port(self) -> int | None:
        """Loopback port of the 3D library's WebSocket, None while it is not ready."""
        return self._port

    @property
    def watching(self) -> int:
        """Number of browsers that watched at the last step."""
        return self._watching

    def wait_ready(self, timeout_s: float) -> bool:
        """Blocks until the picture is ready; False when that took too long."""
        return self._opened.wait(timeout_s)

    def start(self) -> None:
        """Starts the thread; does nothing if it runs already."""
        if self._thread is None:
            self._stop.clear()
            self._thread = threading.Thread(target=self._run, name="twin", daemon=True)
            self._thread.start()

    def publish(self, state: TwinState) -> None:
        """Hands over the newest state. Older ones that were not shown yet are forgotten."""
        self._newest = state
        if self._watching:
            self._changed.set()

    def stop(self) -> None:
        """Stops the thread and closes the port; waits a few seconds for that at most."""
        thread, self._thread = self._thread, None
        self._stop.set()
        self._changed.set()
        if thread is not None:
            thread.join(_JOIN_S)

    def _run(self) -> None:
        try:
            self._serve()
        except Exception:
            # The robot must go on without its picture; the page then says that it is not there.
            logger.exception("The 3D picture has stopped")
        finally:
            self._opened.clear()
            self._port = None
            self._watching = 0

    def _serve(self) -> None:
        # Loaded here because it takes a quarter of a second that server start-up can do without.
        from twin.scene import viser_server  # noqa: PLC0415
        from twin.scene.camera_view import set_first_view  # noqa: PLC0415
        from twin.scene.scene import TwinScene  # noqa: PLC0415

        server = viser_server.open_server()
        try:
            server.gui.configure_theme(show_logo=False, show_share_button=False)
            set_first_view(server, self._geometry)
            scene = TwinScene(
                server.scene,
                self._geometry,
                self._mount,
                hfov_rad=self._hfov_rad,
                aspect=self._aspect,
                loads=self._loads,
                limits=self._limits,
                sag=self._sag,
            )
            self._port = server.get_port()
            self._opened.set()
            self._update(server, scene)
        finally:
            server.stop()

    def _update(self, server: viser.ViserServer, scene: TwinScene) -> None:
        from twin.scene import viser_server  # noqa: PLC0415

        # Read by the page: while this number changes, what it shows is alive. A small counter,
        # because viser drops values that are nearly the same as the last one.
        heartbeat = server.scene.add_frame("/heartbeat", show_axes=False, visible=False)
        shown: TwinState | None = None
        while not self._stop.is_set():
            now = time.monotonic()
            self._watching = viser_server.watchers(server)
            if not self._watching:
                self._stop.wait(_IDLE_STEP_S)
                continue
            self._changed.clear()
            with server.atomic():
                state = self._newest
                if state is not None and state is not shown:
                    scene.show(state)
                    shown = state
                scene.animate(now)
                heartbeat.position = (float(int(now / _BEAT_S) % _HEARTBEATS), 0.0, 0.0)
            # Not more often than the rate, and then as soon as there is something new.
            self._stop.wait(max(0.0, now + STEP_S - time.monotonic()))
            self._changed.wait(_QUIET_STEP_S)
