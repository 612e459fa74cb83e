"""Runs the server until it is told to stop."""

from __future__ import annotations

import asyncio
import contextlib
import errno
import logging
import math
import signal
import socket
import sys
from collections.abc import Callable, Iterator

import uvicorn

from server.announcement import findable, page_address, print_invitation, print_root
from server.api.app import create_app
from server.composition import running
from server.config.errors import ConfigurationError
from server.config.forces import loads_at_limits
from server.config.settings import Settings
from server.connections import allow_many_files, guarded
from server.control.model import RobotMode
from server.storage.folder_lock import holding
from server.tidying import tidying_at_rest
from server.timing import ScaledTimeLoop
from server.tls import TlsFiles, tls_files
from twin.scene import TwinHost
from twin.scene.vanished import forgive_the_vanished

SEND_BUFFER_BYTES = 32 * 1024
"""Small, so that a slow phone is fed the newest state instead of seconds of old ones."""

KEEP_ALIVE_S = 5
PING_S = 20
PING_TIMEOUT_S = 30
SHUTDOWN_S = 2
MAX_MESSAGE_BYTES = 1 << 20
THREADS_TURN_S = 0.001
UNDER_WAY = (RobotMode.HOMING, RobotMode.MOVING, RobotMode.STOPPING)
SIGNALS = (signal.SIGINT, signal.SIGTERM)


class PortInUseError(ConfigurationError):
    """Another program listens on the port."""

    code = "port_in_use"
    title = "The port is in use"
    remedy = "Stop the other program, or choose another port: --port 8001."


class AddressError(ConfigurationError):
    """The address cannot be listened on."""

    code = "address"
    title = "The address cannot be listened on"
    remedy = "Choose another address or port: --host 127.0.0.1 --port 8000."


def serve(settings: Settings) -> None:
    """Run the server; returns when it was interrupted.

    Raises:
        ConfigurationError, StorageError: it cannot start like this.
    """
    logging.basicConfig(
        level=settings.logging.level.upper(),
        format="%(asctime)s %(levelname)s %(name)s: %(message)s",
        stream=sys.stderr,
    )
    logging.getLogger("websockets").setLevel(logging.WARNING)
    # It warns of every piece of nonsense that a stranger sends: he must not fill the log.
    logging.getLogger("uvicorn").setLevel(logging.ERROR)
    allow_many_files()
    # Vision and planning think in threads; the loop that feeds the motion must not wait for them
    # five milliseconds, which is what Python gives a thread by default.
    sys.setswitchinterval(THREADS_TURN_S)
    tls = tls_files(settings)
    listener = _listen(settings.server.host, settings.server.port)
    # A real robot keeps real time; a simulated one waits for a machine that is too slow.
    factory = (lambda: ScaledTimeLoop(settings.clock_speed)) if settings.simulated else None
    with (
        contextlib.closing(listener),
        holding(settings.storage.data_dir),
        asyncio.Runner(loop_factory=factory) as runner,
    ):
        runner.run(_serve(settings, listener, tls))


async def _serve(settings: Settings, listener: socket.socket, tls: TlsFiles | None) -> None:
    forgive_the_vanished(asyncio.get_running_loop())
    optics = settings.camera.optics
    twin = TwinHost(
        settings.geometry,
        settings.camera.mount,
        hfov_rad=2 * math.atan(optics.width / (2 * optics.fx)),
        aspect=optics.width / optics.height,
        loads=loads_at_limits(settings.loads, settings.insertion),
        limits=settings.actuators,
        sag=settings.sag,
    )
    async with running(
        settings, folder=settings.storage.data_dir, twin=twin, wait_for_robot=False
    ) as services:
        services.running_settings.listen(
            lambda now: logging.getLogger().setLevel(now.logging.level.upper())
        )
        app = create_app(lambda: contextlib.nullcontext(services), twin)
        config = _uvicorn_config(app, settings.clock_speed, tls)
        page = page_address(
            "http" if tls is None else "https", settings.server.host, listener.getsockname()[1]
        )
        secret = None
        if not services.access.register.has_owner:
            secret = await services.access.pairing.invite_owner(address="")

        def ready() -> None:
            if secret is not None:
                print_invitation(page, secret, sys.stdout)
            if tls is not None and tls.fingerprint is not None:
                print_root(page, tls.fingerprint, sys.stdout)
            twin.start()

        server = _Server(config, page, when_ready=ready)
        with findable(settings.storage.data_dir, page):
            try:
                async with tidying_at_rest(lambda: services.supervisor.mode not in UNDER_WAY):
                    await server.serve(sockets=[listener])
            finally:
                await asyncio.to_thread(twin.stop)


class _Server(uvicorn.Server):
    """Says in one line where it is, once a browser can come."""

    def __init__(
        self, config: uvicorn.Config, address: str, when_ready: Callable[[], None]
    ) -> None:
        super().__init__(config)
        self._address = address
        self._when_ready = when_ready

    @contextlib.contextmanager
    def capture_signals(self) -> Iterator[None]:
        """End in order at an interrupt.

        After uvicorn's own the signal would kill the process before the robot has been stopped
        and the database closed.
        """
        loop = asyncio.get_running_loop()
        for number in SIGNALS:
            loop.add_signal_handler(number, self.handle_exit, number, None)
        try:
            yield
        finally:
            for number in SIGNALS:
                loop.remove_signal_handler(number)

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets)
        if self.started:
            print(f"PlugPilot is ready: {self._address}", flush=True)
            self._when_ready()


def _uvicorn_config(app: object, speed: float, tls: TlsFiles | None) -> uvicorn.Config:
    """Time limits in the loop's time, which may run faster than the wall clock."""
    return uvicorn.Config(
        app,  # type: ignore[arg-type]
        loop="none",
        http=guarded(speed),
        log_config=None,
        access_log=False,
        ws="websockets-sansio",
        ws_per_message_deflate=False,
        ws_max_size=MAX_MESSAGE_BYTES,
        ws_ping_interval=PING_S * speed,
        ws_ping_timeout=PING_TIMEOUT_S * speed,
        timeout_keep_alive=math.ceil(KEEP_ALIVE_S * speed),
        timeout_graceful_shutdown=math.ceil(SHUTDOWN_S * speed),
        server_header=False,
        ssl_certfile=None if tls is None else tls.certificate,
        ssl_keyfile=None if tls is None else tls.key,
    )


def _listen(host: str, port: int) -> socket.socket:
    try:
        family, kind, protocol, _, address = socket.getaddrinfo(
            host, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE
        )[0]
    except OSError as error:
        raise AddressError(f"{host!r} is not an address of this machine: {error}.") from error
    listener = socket.socket(family, kind, protocol)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, SEND_BUFFER_BYTES)
    try:
        listener.bind(address)
        listener.listen()  # now, so that nobody else can take the port while we start
    except OSError as error:
        listener.close()
        if error.errno == errno.EADDRINUSE:
            raise PortInUseError(f"Another program listens on {host} port {port}.") from error
        raise AddressError(f"Cannot listen on {host} port {port}: {error.strerror}.") from error
    return listener
