"""The command `plugpilot`. Each subcommand is imported only when it is called."""

from __future__ import annotations

import importlib
import sys
from dataclasses import dataclass
from typing import Any

import click

from server.errors import PlugPilotError
from twin.errors import TwinError


@dataclass(frozen=True, slots=True)
class _Subcommand:
    module: str  # holds a click command of the subcommand's name
    summary: str  # stands here too, so that --help imports nothing


_SUBCOMMANDS = {
    "serve": _Subcommand("server.cli.serve", "Run the robot, its pages and its API."),
    "pair": _Subcommand("server.cli.pair", "Make a phone or browser an owner's."),
    "stop": _Subcommand("server.cli.stop", "Stop the robot from its own machine."),
    "audit": _Subcommand("server.cli.audit", "Write out who did what, or check that trail."),
    "simulate": _Subcommand("server.cli.simulate", "Run jobs on the simulator, without pages."),
    "workspace": _Subcommand(
        "server.cli.workspace", "Study the robot's design; find a smaller one."
    ),
    "label": _Subcommand("server.cli.label", "Make a label for a vehicle, to be printed."),
    "locate": _Subcommand("server.cli.locate", "Find the socket in pictures."),
    "calibrate": _Subcommand("server.cli.calibrate", "Find the numbers of this robot's parts."),
    "firmware": _Subcommand("server.cli.firmware", "Build and write the board's firmware."),
    "backup": _Subcommand("server.cli.backup", "Copy the data, also while PlugPilot runs."),
    "restore": _Subcommand("server.cli.restore", "Put a backup in the database's place."),
    "database": _Subcommand("server.cli.database", "Check the database, or begin a new one."),
    "config": _Subcommand("server.cli.config", "Print the settings in force."),
    "version": _Subcommand("server.cli.version", "Print the version."),
}


class _LazyGroup(click.Group):
    """A group that knows its subcommands by name and shows errors as sentences."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        del ctx
        return list(_SUBCOMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        del ctx
        if cmd_name not in _SUBCOMMANDS:
            return None
        command = getattr(importlib.import_module(_SUBCOMMANDS[cmd_name].module), cmd_name)
        if not isinstance(command, click.Command):
            msg = f"{_SUBCOMMANDS[cmd_name].module}.{cmd_name} is no click command"
            raise TypeError(msg)
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        del ctx
        with formatter.section("Commands"):
            formatter.write_dl([(name, command.summary) for name, command in _SUBCOMMANDS.items()])

    def invoke(self, ctx: click.Context) -> Any:  # noqa: ANN401 - as click declares it
        try:
            return super().invoke(ctx)
        except PlugPilotError as error:
            click.echo(f"{error.detail}\n{error.remedy}", err=True)
            sys.exit(2)
        except TwinError as error:
            click.echo(f"{_sentence(str(error))}\n{error.remedy}", err=True)
            sys.exit(2)


def _sentence(clause: str) -> str:
    """The mathematics speaks in clauses, because they become part of longer sentences."""
    return clause[:1].upper() + clause[1:] + ("" if clause.endswith(".") else ".")


@click.group(cls=_LazyGroup, context_settings={"help_option_names": ["-h", "--help"]})
def main() -> None:
    """PlugPilot: the software of the robot that plugs an electric car in."""
