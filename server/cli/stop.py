"""`plugpilot stop`: stops the robot from its own machine, without being paired."""

from __future__ import annotations

import ssl
from pathlib import Path
from urllib.parse import urlsplit

import click

from server.config import Option, load_settings
from server.errors import PlugPilotError

PATIENCE_S = 5.0


class NotRunningError(PlugPilotError):
    """There is no server to ask."""

    code = "not_running"
    title = "PlugPilot does not run here"
    remedy = "Name its data folder with --data-dir, or press the emergency stop button."


class StopFailedError(PlugPilotError):
    """The server did not confirm the stop."""

    code = "stop_failed"
    title = "The stop was not confirmed"
    remedy = "Press the emergency stop button on the robot."


@click.command()
@click.option("--config", type=click.Path(path_type=Path), help="Configuration file.")
@click.option("--data-dir", help="Folder of the running server.  [storage.data_dir, ./data]")
@click.option("--emergency", is_flag=True, help="Emergency stop: switches the drives off, too.")
def stop(*, config: Path | None, data_dir: str | None, emergency: bool) -> None:
    """Stop the robot. On its own machine nobody needs to be paired for that."""
    settings = load_settings(config, [Option("--data-dir", "storage.data_dir", data_dir)])
    import httpx  # noqa: PLC0415 - loaded only to ask

    from server.announcement import address_of_running  # noqa: PLC0415

    page = address_of_running(settings.storage.data_dir)
    if page is None:
        raise NotRunningError(f"No server runs with {settings.storage.data_dir}.")
    parts = urlsplit(page)
    host = "127.0.0.1" if settings.server.host in {"0.0.0.0", "::"} else parts.hostname  # noqa: S104
    address = f"{parts.scheme}://{host}:{parts.port}/api/v1/robot/"
    # A stop carries no secret and goes to this very machine: the certificate, which need not be
    # valid for the loopback address, proves nothing that matters here.
    unverified = ssl.create_default_context()
    unverified.check_hostname, unverified.verify_mode = False, ssl.CERT_NONE
    try:
        answer = httpx.post(
            address + ("estop" if emergency else "stop"),
            verify=unverified,
            trust_env=False,
            timeout=PATIENCE_S,
        )
        answer.raise_for_status()
    except httpx.HTTPError as error:
        raise StopFailedError(f"The server at {page} did not confirm: {error}.") from error
    click.echo(f"Stopped. The robot says: {answer.json()['mode']}.")
