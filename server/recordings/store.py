"""The folder of the recordings: what is there, what is too old, what a power cut has left."""

from __future__ import annotations

import logging
import shutil
import time
from pathlib import Path

from server.config.recordings import MEGABYTE, RecordingSettings
from server.recordings.errors import NoRecordingError, RecordingRunningError
from server.recordings.file import UNFINISHED, RecordingFile
from server.recordings.reader import join, repair
from server.schema.jobs import Job, RecordingInfo

_log = logging.getLogger(__name__)

FOLDER = "recordings"
ENDING = ".mcap"
PLAYBACK_ENDING = ".viser"
JOINED = ".joined"
"""Ending of a file that is being made of several."""
DAY_S = 86_400.0
MARKS_ENDING = ".marks.json"
CUT = ".cut"
"""Ending of a file that a power cut has left, while it is being repaired."""
EARLIER = ".earlier"
"""Ending of what was recorded of a job before a restart, while it is recorded further."""


class RecordingStore:
    """Recordings by the id of their job. Methods that say so block; call them from a thread.

    Args:
        folder: The data folder; None keeps nothing.
        settings: Limits.
    """

    def __init__(self, folder: Path | None, settings: RecordingSettings) -> None:
        self._folder = None if folder is None or not settings.enabled else folder / FOLDER
        self._settings = settings
        self._running: str | None = None

    @property
    def enabled(self) -> bool:
        """Whether jobs are recorded at all."""
        return self._folder is not None

    def begin(self, job_id: str) -> RecordingFile:
        """Make room, then a file for a job. Blocks.

        What was recorded of the job before a restart is kept beside it until ``ended``.

        Raises:
            OSError: the folder cannot be written, or the disk is too full.
        """
        folder = self._require_folder()
        self.tidy()
        free_mb = shutil.disk_usage(folder).free / MEGABYTE
        if free_mb < self._settings.min_free_mb:
            msg = f"only {free_mb:.0f} MB are free on the disk"
            raise OSError(msg)
        whole = self._path(job_id)
        if whole.is_file():
            self._join(job_id)
            whole.replace(self._earlier(job_id))
        file = RecordingFile(whole)
        self._running = job_id
        return file

    def ended(self) -> None:
        """The file that was begun is finished or abandoned: make one of all of the job. Blocks.

        Raises:
            OSError: the disk refused; the next start tries again.
        """
        job_id, self._running = self._running, None
        if job_id is not None:
            self._join(job_id)

    def path(self, job_id: str) -> Path:
        """The finished recording of a job.

        Raises:
            NoRecordingError: there is none.
            RecordingRunningError: it is not finished.
        """
        if job_id == self._running:
            raise RecordingRunningError("It can be opened when the job has ended.", job_id=job_id)
        if self._folder is None or not self._path(job_id).is_file():
            raise NoRecordingError(f"Nothing is kept of job {job_id}.", job_id=job_id)
        return self._path(job_id)

    def playback_paths(self, job_id: str) -> tuple[Path, Path]:
        """Where the 3D playback of a recording and its marks belong; they need not be there."""
        recording = self._path(job_id)
        return recording.with_suffix(PLAYBACK_ENDING), recording.with_suffix(MARKS_ENDING)

    def show(self, job: Job) -> Job:
        """The job together with what is known of its recording."""
        if self._folder is None or job.id == self._running:
            return job
        try:
            size_bytes = self._path(job.id).stat().st_size
        except OSError:
            return job
        return job.model_copy(update={"recording": RecordingInfo(size_bytes=size_bytes)})

    def open(self) -> None:
        """Make the folder and repair what a power cut has left. Blocks.

        Raises:
            OSError: the folder cannot be made.
        """
        folder = self._require_folder()
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        for half in folder.glob(f"*{JOINED}*"):
            half.unlink()
        for unfinished in folder.glob(f"*{ENDING}{UNFINISHED}"):
            unfinished.replace(unfinished.with_name(unfinished.name.removesuffix(UNFINISHED) + CUT))
        for cut in sorted(folder.glob(f"*{ENDING}{CUT}")):
            whole = cut.with_name(cut.name.removesuffix(CUT))
            saved = repair(cut, whole)
            _log.info("the recording %s was cut short; saved: %s", whole.stem, saved)
        for earlier in sorted(folder.glob(f"*{ENDING}{EARLIER}")):
            self._join(earlier.name.removesuffix(EARLIER).removesuffix(ENDING))
        self.tidy()

    def tidy(self) -> None:
        """Delete what is too old, and the oldest recordings beyond the limits. Blocks.

        Ids of jobs sort by time.
        """
        folder = self._require_folder()
        total_mb = 0.0
        newest_first = sorted(folder.glob(f"*{ENDING}"), reverse=True)
        oldest_s = time.time() - self._settings.max_age_days * DAY_S
        for kept, path in enumerate(newest_first, start=1):
            files = [
                file
                for ending in (ENDING, PLAYBACK_ENDING, MARKS_ENDING)
                if (file := path.with_suffix(ending)).is_file()
            ]
            total_mb += sum(file.stat().st_size for file in files) / MEGABYTE
            too_many = kept > self._settings.max_count or total_mb > self._settings.max_total_mb
            if too_many or path.stat().st_mtime < oldest_s:
                for file in files:
                    file.unlink(missing_ok=True)

    def _join(self, job_id: str) -> None:
        """Make one recording of what was recorded of a job before and after a restart."""
        whole, earlier = self._path(job_id), self._earlier(job_id)
        if not earlier.is_file():
            return
        if not whole.is_file():
            earlier.replace(whole)
            return
        together = whole.with_name(whole.name.removesuffix(ENDING) + JOINED)
        join([earlier, whole], together)
        together.replace(whole)
        earlier.unlink()

    def _earlier(self, job_id: str) -> Path:
        return self._require_folder() / f"{job_id}{ENDING}{EARLIER}"

    def _path(self, job_id: str) -> Path:
        return self._require_folder() / f"{job_id}{ENDING}"

    def _require_folder(self) -> Path:
        if self._folder is None:
            raise AssertionError("nothing is recorded, and yet somebody asked for the folder")
        return self._folder
