"""The diagnostics bundle: one file with what somebody far away needs to find a cause.

Names of people and addresses in the home stand in it, secrets do not.
"""

from __future__ import annotations

import asyncio
import contextlib
import io
import json
import zipfile
from collections.abc import Mapping
from typing import Any

from server.services import Services
from server.technician.redaction import Redaction
from server.technician.versions import versions

AUDIT_ENTRIES = 500
JOBS = 50
FRAMES = 1000

README = """Diagnostics of PlugPilot

versions.json       software, libraries, firmware, protocol
live.json           robot, job, station, service, twin, guidance at this moment
link.json           the link to the motion board and the camera
configuration.json  all settings in force, and what was changed over the API
log.txt             the newest lines of the log
audit.jsonl         who did what, the newest entries
jobs.json           the newest jobs and their recordings (the recordings themselves are not here)
protocol.txt        what went over the link to the board while this file was made

Passwords, keys and other secrets are hidden. Names of people and addresses in the home are not.
"""


async def make_bundle(services: Services) -> bytes:
    """Collect everything; takes as long as the console listens, about a second.

    Returns:
        A zip file.

    Raises:
        StorageError: the database cannot be read.
    """
    settings = services.running_settings.current
    texts = {
        "README.txt": README,
        "versions.json": versions(services.supervisor.identity).model_dump_json(indent=1),
        "live.json": await _live(services),
        "link.json": _json(_link(services)),
        "configuration.json": _json(await _configuration(services)),
        "audit.jsonl": await _audit(services),
        "jobs.json": _json(await _jobs(services)),
        "protocol.txt": await _protocol(services),
        "log.txt": "\n".join(services.technician.log.lines) + "\n",
    }
    redaction = Redaction(settings)
    return await asyncio.to_thread(_packed, texts, redaction)


async def _live(services: Services) -> str:
    watching = services.live.watch()
    async with contextlib.aclosing(watching):  # type: ignore[type-var]  # it is a generator
        return (await anext(watching)).decode()


def _link(services: Services) -> dict[str, Any]:
    supervisor = services.supervisor
    trouble = supervisor.link_trouble
    return {
        "board": supervisor.name,
        "link": services.technician.link.report().model_dump(mode="json"),
        "trouble": None if trouble is None else str(trouble),
        "camera_online": services.camera.online,
        "station": services.station.name,
        "station_online": services.station.online,
        "watchers": services.live.watchers,
    }


async def _configuration(services: Services) -> dict[str, Any]:
    running = services.running_settings
    return {
        "settings": running.current.model_dump(mode="json"),
        "versions": [
            {
                "number": each.number,
                "at": each.at.isoformat(),
                "by": each.by,
                "changes": each.changes,
            }
            for each in await running.versions()
        ],
    }


async def _audit(services: Services) -> str:
    entries = await services.access.audit.page(before=None, limit=AUDIT_ENTRIES)
    return "".join(json.dumps(entry.as_json()) + "\n" for entry in reversed(entries))


async def _jobs(services: Services) -> list[dict[str, Any]]:
    jobs = await services.jobs.page(before=None, limit=JOBS)
    return [services.recordings.show(job).model_dump(mode="json") for job in jobs]


async def _protocol(services: Services) -> str:
    """What passes while this waits; more if somebody has the console open."""
    console = services.technician.console
    first = await console.after(0, FRAMES)
    then = await console.after(first.newest, FRAMES)
    lines = [
        f"{frame.at.isoformat()} {'->' if frame.direction == 'to_board' else '<-'} {frame.kind} "
        f"{'ERROR ' if frame.error else ''}{frame.words}"
        for frame in [*first.frames, *then.frames]
    ]
    return "\n".join(lines) + "\n"


def _json(content: object) -> str:
    return json.dumps(content, indent=1, default=str)


def _packed(texts: Mapping[str, str], redaction: Redaction) -> bytes:
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as bundle:
        for name, text in texts.items():
            bundle.writestr(name, redaction.clean(text))
    return file.getvalue()
