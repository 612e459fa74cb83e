"""Whole jobs on the simulator: `python -m tests.bench.jobs [SEEDS]`.

Accuracy, force and time of plugging in, as the simulated garage really saw them, with the time
compared to what the joint limits alone would allow. `make campaign` does the same for 100 cars.
"""

from __future__ import annotations

import sys

from server.cli.simulated_job import as_line, as_summary
from server.config.settings import Settings
from server.config.simulation import SimulationSettings
from server.jobs.model import JobType
from server.schema.jobs import JobRequest
from server.simulation import simulate

SEEDS = 10

AIMS = "Aims: lateral error 0.5 mm, depth within 1 mm, force 80 N, 1.25 times the limit"


def main(seeds: int) -> None:
    """Run one job for each seed and print."""
    request = JobRequest(type=JobType.PLUG_IN)
    outcomes = []
    for seed in range(seeds):
        settings = Settings(simulation=SimulationSettings(seed=seed))
        outcomes.append(simulate(settings, request))
        print(as_line(outcomes[-1]))
    print(as_summary(outcomes))
    print(AIMS)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else SEEDS)
