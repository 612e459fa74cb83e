"""The 3D library's server, closed to everything but our own bridge.

Everything here that starts with an underscore in viser is private to it. The dependency is
pinned to one version and every hook has a test of its own.
"""

from __future__ import annotations

import socket
from typing import TYPE_CHECKING

import rich
import viser
from viser import _messages as messages

from twin.scene.message_buffer import send_what_is_kept
from twin.scene.vanished import forgive_the_vanished

if TYPE_CHECKING:
    from viser.infra import WebsockClientConnection

LOOPBACK = "127.0.0.1"
SEND_BUFFER_BYTES = 32 * 1024
"""Kernel buffer of each connection. The default grows to megabytes, which would be minutes of
stale poses for a slow phone; with a small one viser sends the newest state instead."""


def open_server() -> viser.ViserServer:
    """Starts viser on a free loopback port, without its public share tunnel.

    Any client can ask viser for a tunnel that opens the server to the internet, so the handlers
    of those requests are taken away.
    """
    rich.get_console().quiet = True  # viser prints a banner whatever it is told
    server = viser.ViserServer(host=LOOPBACK, port=0, verbose=False)
    raw = server._websock_server  # noqa: SLF001
    raw.unregister_handler(messages.ShareUrlRequest)
    raw.unregister_handler(messages.ShareUrlDisconnect)
    forgive_the_vanished(server.get_event_loop())

    send_what_is_kept(server)

    @raw.on_client_connect
    def _(connection: WebsockClientConnection) -> None:
        live = raw._live_connections.get(connection.client_id)  # noqa: SLF001
        if live is not None:
            peer = live.transport.get_extra_info("socket")
            peer.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, SEND_BUFFER_BYTES)

    return server


def watchers(server: viser.ViserServer) -> int:
    """Number of connected browsers."""
    return len(server._websock_server._live_connections)  # noqa: SLF001
