"""A simulated board with the real firmware, to be driven by a server: ``python -m tests.rig``."""

from __future__ import annotations

import asyncio
import contextlib
import signal
import tempfile
from pathlib import Path

import click

from server.config import Option, Settings, load_settings
from tests.rig.build import BuildError, Programs, build_programs, missing_packages
from tests.rig.garage import GarageAroundRig
from tests.rig.machine import STANDING, Machine
from tests.rig.standalone import standing_alone
from tests.rig.standalone_screen import HELP, obey, show

DEFAULT_PORT = Path(tempfile.gettempdir()) / "plugpilot-board"


@click.command()
@click.option("--seed", help="Of the car in front of it, as of the server.  [simulation.seed, 0]")
@click.option(
    "--port",
    type=click.Path(path_type=Path),
    default=DEFAULT_PORT,
    show_default=True,
    help="Where the device of its USB port appears.",
)
@click.option("--config", type=click.Path(path_type=Path), help="The server's configuration file.")
def main(*, seed: str | None, port: Path, config: Path | None) -> None:
    """Run a simulated board with the real firmware until Ctrl+C.

    In front of it stands the very car that a server with the same seed sees, so the plug meets the
    forces of its socket.
    """
    if port.exists() and not port.is_symlink():
        raise click.BadParameter(f"{port} exists and is no link.", param_hint="--port")
    missing = missing_packages()
    if missing:
        raise click.ClickException(f"These packages are missing: {' '.join(missing)}")
    settings = load_settings(config, [Option("--seed", "simulation.seed", seed)])
    try:
        programs = build_programs()
    except BuildError as error:
        raise click.ClickException(str(error)) from error
    with contextlib.suppress(KeyboardInterrupt):
        asyncio.run(_run(programs, settings, port.absolute()))
    click.echo()


async def _run(programs: Programs, settings: Settings, port: Path) -> None:
    machine = Machine(settings.geometry, settings.robot.board, STANDING)
    async with standing_alone(programs, machine, port) as board:
        around = GarageAroundRig(
            board, settings.camera.optics, settings.simulation.parameters, settings.simulation.seed
        )
        click.echo(f"The board's port is {port}. Drive it from another terminal with:\n")
        click.echo(f"    {_command(settings, port)}\n\n{HELP}\n\nCtrl+C ends it.\n")
        ended = asyncio.Event()
        loop = asyncio.get_running_loop()
        loop.add_signal_handler(signal.SIGTERM, ended.set)
        tasks = [
            asyncio.create_task(show(board, around.garage.world.truth)),
            asyncio.create_task(obey(board.control)),
            asyncio.create_task(ended.wait()),
        ]
        try:
            done, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
            for task in done:
                task.result()
        finally:
            for task in tasks:
                task.cancel()
            await asyncio.wait(tasks)


def _command(settings: Settings, port: Path) -> str:
    seed = settings.simulation.seed
    chance = f" --seed {seed}" if seed else ""
    return f".venv/bin/plugpilot serve --driver arduino --port {port}{chance}"


if __name__ == "__main__":
    main()
