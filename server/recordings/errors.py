"""Errors of recordings.

RecordingError
├── NoRecordingError       nothing was recorded of this job, or it was deleted since
├── RecordingRunningError  the job is still being recorded
└── PlaybackFailedError    the recording cannot be shown in 3D
"""

from __future__ import annotations

from server.errors import PlugPilotError


class RecordingError(PlugPilotError):
    """A recording cannot be had."""

    code = "recording"
    title = "The recording cannot be opened"
    status = 500


class NoRecordingError(RecordingError):
    """Nothing was recorded of this job, or it was deleted since."""

    code = "no_recording"
    title = "There is no recording of this job"
    status = 404
    remedy = "Old recordings make room for new ones: see [recordings] in the configuration."


class RecordingRunningError(RecordingError):
    """The job is still being recorded."""

    code = "recording_running"
    title = "This job is still being recorded"
    status = 409
    remedy = "Wait until the job has ended."


class PlaybackFailedError(RecordingError):
    """The recording cannot be shown in 3D."""

    code = "playback_failed"
    title = "This recording cannot be shown in 3D"
    status = 500
    remedy = "Download the recording instead. The log says what went wrong."
