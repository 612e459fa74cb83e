"""What a job may do while nothing can be kept: no plug goes in, every plug comes out.

A way in needs its journal, because a power cut may come at any moment. The way out needs only the
plug's place, which has a file of its own (``server.storage.plug_file``).
"""

from __future__ import annotations

from server.jobs.model import JobPhase, JobType
from server.schema.jobs import Job

WAY_IN = {JobPhase.PREFLIGHT, JobPhase.LOCATING, JobPhase.ALIGNING, JobPhase.INSERTING}

SEATED = {JobPhase.PLUGGED, JobPhase.CHARGING}


def may_begin(job: Job, before: JobPhase | None) -> bool:
    """Whether a job may begin its phase without a journal on disk.

    From the way in it does not go on to charging either: after a power cut the journal on disk
    would still say that the plug is on its way in, and the job would begin anew.

    Args:
        job: In the phase that it wants to begin.
        before: The phase that it was in; None for a new job.
    """
    if job.type is JobType.UNPLUG:
        return True
    if job.phase in SEATED:
        return before is not None and before not in WAY_IN
    return job.phase not in WAY_IN
