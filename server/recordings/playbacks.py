"""Makes 3D playbacks of recordings, each once, in a process of its own.

Building the scene and packing it takes seconds of computing that must not slow the robot down, and
a library whose memory is better given back afterwards.
"""

from __future__ import annotations

import asyncio
import logging
import subprocess
import sys
from pathlib import Path

from server.config.recordings import MEGABYTE, RecordingSettings
from server.recordings.errors import PlaybackFailedError
from server.recordings.store import RecordingStore
from server.schema.jobs import Playback

_log = logging.getLogger(__name__)

TIMEOUT_S = 180.0
MODULE = "server.recordings.make_playback"


class Playbacks:
    """Playbacks of finished recordings, kept beside them.

    Args:
        store: The recordings.
        settings: Rate of the playback and its limits.
    """

    def __init__(self, store: RecordingStore, settings: RecordingSettings) -> None:
        self._store = store
        self._settings = settings
        self._one_at_a_time = asyncio.Lock()

    async def path(self, job_id: str) -> Path:
        """The file of a job's playback; made if it is not there yet.

        Raises:
            As `marks`.
        """
        await self.marks(job_id)
        return self._store.playback_paths(job_id)[0]

    async def marks(self, job_id: str) -> Playback:
        """What happens when in a job's playback, which is made if it is not there yet.

        Raises:
            NoRecordingError, RecordingRunningError: there is nothing to play.
            PlaybackFailedError: it cannot be made.
        """
        recording = self._store.path(job_id)
        playback, marks = self._store.playback_paths(job_id)
        async with self._one_at_a_time:
            return await asyncio.to_thread(self._marks, recording, playback, marks)

    def _marks(self, recording: Path, playback: Path, marks: Path) -> Playback:
        if not (_is_newer(playback, recording) and _is_newer(marks, playback)):
            self._make(recording, playback, marks)
        return Playback.model_validate_json(marks.read_bytes())

    def _make(self, recording: Path, playback: Path, marks: Path) -> None:
        unfinished = playback.with_name(playback.name + ".part")
        command = [
            *(sys.executable, "-m", MODULE, str(recording), str(unfinished)),
            *("--rate", f"{self._settings.playback_rate_hz}"),
            *("--pause", f"{self._settings.playback_pause_s}"),
        ]
        try:
            done = subprocess.run(  # noqa: S603 - our own module
                command, capture_output=True, text=True, timeout=TIMEOUT_S, check=False
            )
            if done.returncode != 0:
                _log.error("no playback of %s: %s", recording.name, done.stderr.strip())
                raise PlaybackFailedError(f"Making the playback of {recording.stem} failed.")
            size_mb = unfinished.stat().st_size / MEGABYTE
            if size_mb > self._settings.max_one_mb:
                raise PlaybackFailedError(f"The playback would take {size_mb:.0f} MB.")
            unfinished.replace(playback)
            marks.write_text(done.stdout)
        except subprocess.TimeoutExpired as error:
            raise PlaybackFailedError(
                f"Making the playback took more than {TIMEOUT_S:.0f} s."
            ) from error
        except OSError as error:
            raise PlaybackFailedError(f"The playback cannot be kept: {error.strerror}.") from error
        finally:
            unfinished.unlink(missing_ok=True)


def _is_newer(playback: Path, recording: Path) -> bool:
    try:
        return playback.stat().st_mtime_ns >= recording.stat().st_mtime_ns
    except FileNotFoundError:
        return False
