"""Makes the 3D playback of one recording: ``python -m server.recordings.make_playback IN OUT``.

Runs in a process of its own, with low priority; prints the marks as JSON.
"""

from __future__ import annotations

import argparse
import math
import os
import sys
from pathlib import Path

from server.recordings.reader import read_recording
from server.recordings.timeline import timeline
from server.recordings.topics import PictureRecord
from server.schema.jobs import Playback
from twin.scene.playback import build_playback

NICENESS = 10


def main() -> None:
    """Read the arguments and do it."""
    parser = argparse.ArgumentParser(description="Make the 3D playback of a recording.")
    parser.add_argument("recording", type=Path)
    parser.add_argument("playback", type=Path)
    parser.add_argument("--rate", type=float, default=20.0, help="frames per second")
    parser.add_argument("--pause", type=float, default=2.0, help="longest wait [s]")
    options = parser.parse_args()
    os.nice(NICENESS)
    marks = make_playback(
        options.recording, options.playback, rate_hz=options.rate, pause_s=options.pause
    )
    sys.stdout.write(marks.model_dump_json())


def make_playback(recording: Path, playback: Path, *, rate_hz: float, pause_s: float) -> Playback:
    """Write the playback of a recording and return what happens when in it.

    Raises:
        OSError: a file cannot be read or written.
        NothingToPlayError: there is no motion in the recording.
    """
    entries = (e for e in read_recording(recording) if not isinstance(e.record, PictureRecord))
    reel = timeline(entries, rate_hz=rate_hz, pause_s=pause_s)
    optics = reel.robot.optics
    packed = build_playback(
        reel.robot.geometry,
        reel.robot.mount,
        hfov_rad=2 * math.atan(optics.width / (2 * optics.fx)),
        aspect=optics.width / optics.height,
        loads=reel.robot.loads,
        limits=reel.robot.limits,
        sag=reel.robot.sag,
        frames=reel.frames,
    )
    playback.write_bytes(packed)
    return Playback(duration_s=round(reel.frames[-1].at_s, 2), marks=reel.marks)


if __name__ == "__main__":
    main()
