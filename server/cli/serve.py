"""`plugpilot serve`: the robot, its pages and its API in one process."""

from __future__ import annotations

from pathlib import Path

import click

from server.cli.ports import port_options, require_board_for_serial
from server.config import Option, load_settings


@click.command()
@click.option(
    "--config",
    type=click.Path(path_type=Path),
    help="Configuration file.  [default: $PLUGPILOT_CONFIG, else ./plugpilot.toml if there is one]",
)
@click.option("--host", help="Address to listen on.  [server.host, 127.0.0.1]")
@click.option(
    "--port",
    "ports",
    multiple=True,
    help="A number: TCP port, 0 for any free one.  [server.port, 8000]  "
    "Anything else, such as /dev/ttyUSB0, COM3 or auto: as --serial. May be given for both.",
)
@click.option(
    "--serial",
    metavar="DEVICE",
    help="Serial port of the motion board, auto to look for it.  [robot.port, auto]",
)
@click.option("--data-dir", help="Folder of database and recordings.  [storage.data_dir, ./data]")
@click.option("--driver", help="simulator or arduino.  [robot.driver, simulator]")
@click.option(
    "--tls",
    "tls",
    is_flag=True,
    help="https with a certificate of this installation's own authority.  [tls.mode, off]",
)
@click.option("--speed", help="Simulated seconds per second.  [simulation.speed, 1]")
@click.option("--seed", help="Chance of the simulated world.  [simulation.seed, 0]")
def serve(
    *,
    config: Path | None,
    host: str | None,
    ports: tuple[str, ...],
    serial: str | None,
    data_dir: str | None,
    driver: str | None,
    tls: bool,
    speed: str | None,
    seed: str | None,
) -> None:
    """Run the robot, its pages and its API until it is interrupted.

    An option wins over an environment variable such as PLUGPILOT_SERVER__PORT, that wins over the
    configuration file. `plugpilot config` prints what is in force.
    """
    port_settings = port_options(ports, serial)
    settings = load_settings(
        config,
        [
            Option("--host", "server.host", host),
            *port_settings,
            Option("--data-dir", "storage.data_dir", data_dir),
            Option("--driver", "robot.driver", driver),
            Option("--tls", "tls.mode", "own" if tls else None),
            Option("--speed", "simulation.speed", speed),
            Option("--seed", "simulation.seed", seed),
        ],
    )
    require_board_for_serial(port_settings, settings)
    # imported late: wrong settings are told without waiting for vision and the scene to load
    from server.calibration.camera.in_force import with_camera_calibration  # noqa: PLC0415
    from server.serving import serve as run  # noqa: PLC0415

    run(with_camera_calibration(settings))
