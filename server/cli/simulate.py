"""`plugpilot simulate`: jobs in virtual time, without pages."""

from __future__ import annotations

import json
import math
from pathlib import Path

import click

from server.config import Option, load_settings
from server.config.settings import Settings
from server.jobs.model import JobType

_config = click.option(
    "--config",
    type=click.Path(path_type=Path),
    help="Configuration file.  [default: $PLUGPILOT_CONFIG, else ./plugpilot.toml if there is one]",
)
_type = click.option(
    "--type",
    "job_type",
    type=click.Choice([JobType.PLUG_IN.value, JobType.CHARGE.value]),
    default=JobType.PLUG_IN.value,
    show_default=True,
    help="What to do.",
)
_energy = click.option(
    "--energy-wh",
    type=click.FloatRange(min=0, min_open=True, max=200_000),
    help="Charge: stop after this much energy.  [until the car is full]",
)
_json = click.option("--json", "as_json", is_flag=True, help="Print JSON instead of a table.")


_SIMULATORS = [
    Option("this command", f"{device}.driver", "simulator")
    for device in ("robot", "camera", "station")
]
"""A configuration made for a real robot can be tried out; nothing of it moves."""


@click.group()
def simulate() -> None:
    """Run jobs on the simulator in virtual time, as fast as they can be computed."""


@simulate.command()
@click.option("--seed", help="Chance of the simulated world.  [simulation.seed, 0]")
@_type
@_energy
@_json
@_config
def job(
    *, seed: str | None, job_type: str, energy_wh: float | None, as_json: bool, config: Path | None
) -> None:
    """Run one job; exit status 1 when it did not succeed."""
    _check_energy(job_type, energy_wh)
    settings = load_settings(config, [Option("--seed", "simulation.seed", seed), *_SIMULATORS])
    # imported late: wrong settings are told without waiting for vision to load
    from server.cli.simulated_job import as_document, as_table  # noqa: PLC0415
    from server.schema.jobs import JobRequest  # noqa: PLC0415
    from server.simulation import simulate as run  # noqa: PLC0415

    request = JobRequest(type=JobType(job_type), target_energy_wh=energy_wh)
    outcome = run(settings, request)
    click.echo(as_document(outcome) if as_json else as_table(outcome))
    if not outcome.succeeded:
        raise SystemExit(1)


@simulate.command()
@click.option("--seeds", default="0-99", show_default=True, help="First and last seed.")
@_type
@_energy
@_json
@_config
def campaign(
    *, seeds: str, job_type: str, energy_wh: float | None, as_json: bool, config: Path | None
) -> None:
    """Run one job for each of many seeds; exit status 1 when one did not succeed."""
    _check_energy(job_type, energy_wh)
    numbers = _seeds(seeds)
    settings = load_settings(config, _SIMULATORS)
    from server.cli.simulated_job import as_document, as_line, as_summary  # noqa: PLC0415
    from server.schema.jobs import JobRequest  # noqa: PLC0415
    from server.simulation import simulate as run  # noqa: PLC0415

    request = JobRequest(type=JobType(job_type), target_energy_wh=energy_wh)
    outcomes = []
    for seed in numbers:
        outcome = run(_with_seed(settings, seed), request)
        outcomes.append(outcome)
        click.echo(as_document(outcome) if as_json else as_line(outcome))
    if not as_json:
        click.echo(as_summary(outcomes))
    if not all(outcome.succeeded for outcome in outcomes):
        raise SystemExit(1)


@simulate.command()
@click.option("--seeds", default="0", show_default=True, help="One robot, or first and last.")
@click.option(
    "--keep",
    type=click.Path(path_type=Path, dir_okay=False),
    help="Write each robot's figures there, and pass over those that are there already.",
)
@_json
@_config
def calibration(*, seeds: str, keep: Path | None, as_json: bool, config: Path | None) -> None:
    """Calibrate robots built by chance, and show how far they miss before and after.

    Lengths are off by millimetres, rails skewed, belts stretched, the camera turned by degrees.
    Then the socket is taught by hand, the car parks elsewhere, and a whole job plugs it in. Exit
    status 1 when one of these did not succeed.
    """
    numbers = _seeds(seeds)
    settings = load_settings(config, _SIMULATORS)
    from server.cli import simulated_calibration as text  # noqa: PLC0415
    from server.simulated_calibration import simulate_calibration  # noqa: PLC0415

    kept = text.kept_documents(keep)
    documents = []
    for seed in numbers:
        document = kept.get(seed)
        if document is None:
            outcome = simulate_calibration(_with_seed(settings, seed))
            document = text.as_document(outcome)
            if keep is not None:
                with keep.open("a", encoding="utf-8") as file:
                    file.write(json.dumps(document) + "\n")
            if len(numbers) == 1 and not as_json:
                click.echo(text.as_table(outcome))
        documents.append(document)
        if as_json or len(numbers) > 1:
            click.echo(json.dumps(document) if as_json else text.as_line(document))
    if len(numbers) > 1 and not as_json:
        click.echo(text.as_summary(documents))
    if any(document["lateral_mm"] is None for document in documents):
        raise SystemExit(1)


def _check_energy(job_type: str, energy_wh: float | None) -> None:
    if energy_wh is not None and job_type != JobType.CHARGE.value:
        raise click.BadParameter("goes with --type charge only.", param_hint="--energy-wh")
    if energy_wh is not None and not math.isfinite(energy_wh):  # a range lets NaN through
        raise click.BadParameter(f"{energy_wh} is not a number.", param_hint="--energy-wh")


def _seeds(text: str) -> range:
    first, _, last = text.partition("-")
    try:
        numbers = range(int(first), int(last or first) + 1)
    except ValueError:
        numbers = range(0)
    if not numbers:
        raise click.BadParameter(
            f"{text!r} is not a range of seeds such as 0-99.", param_hint="--seeds"
        )
    return numbers


def _with_seed(settings: Settings, seed: int) -> Settings:
    simulation = settings.simulation.model_copy(update={"seed": seed})
    return settings.model_copy(update={"simulation": simulation})
