"""A left belt that stretches, job after job, on the whole simulator in virtual time.

Prints how far the tip misses places all over the regular box (p95), with what the jobs have taught
and as it would be if nobody had looked. Run as ``python -m tests.bench.drift [jobs] [stretch_%]``.
"""

from __future__ import annotations

import sys
import time

import numpy as np

from server.jobs.model import JobType
from server.simulated_calibration import tip_errors_mm
from server.simulated_technician import SimulatedTechnician
from tests.support import garage
from tests.support.garage import Scene, on_scene

PARKS_WITHIN_MM = 30.0


def main(jobs: int, stretch: float) -> None:
    """Run the jobs and print a line for every tenth."""

    async def scenario(scene: Scene) -> None:
        services, world = scene.services, scene.garage.world
        geometry, as_drawn = services.settings.geometry, services.supervisor.built
        technician = SimulatedTechnician(services, world, np.random.default_rng(1))
        began_s, failed, usual = time.perf_counter(), 0, world.car
        print("jobs  learnt  belt_%  seen_%  ignored_mm  kept_mm  proven  versions  hints")
        for number in range(1, jobs + 1):
            mechanism = world.plant.mechanism
            scale = mechanism.left_scale * (1 + stretch / jobs)
            world.plant.mechanism = mechanism.model_copy(update={"left_scale": scale})
            technician.park_elsewhere(PARKS_WITHIN_MM, usual)
            for kind in (JobType.PLUG_IN, JobType.UNPLUG):
                error = (await scene.carried_out(kind)).error
                if error is not None:
                    failed += 1
                    print(f"job {number}, {kind.value}: {error.code}: {error.detail}", flush=True)
                    break
            await services.self_calibration.settled()
            if number % 10 and number < jobs:
                continue
            report = services.self_calibration.report
            kept, ignored = (
                np.percentile(tip_errors_mm(world, geometry, built), 95)
                for built in (services.supervisor.built, as_drawn)
            )
            versions = await services.calibrations.page(kind=None, before=None, limit=99)
            print(
                f"{number:4d}  {report.belts.jobs:6d}  {100 * stretch * number / jobs:6.3f}  "
                f"{report.belts.left_percent:6.3f}  {ignored:10.3f}  {kept:7.3f}  "
                f"{report.belts.proven_mm:6.2f}  {len(versions):8d}  "
                f"{','.join(hint.code for hint in report.hints) or '-'}",
                flush=True,
            )
        print(f"{failed} jobs failed; {time.perf_counter() - began_s:.0f} s of computing")

    garage.LONG_S = 1e6
    on_scene(scenario, seed=2)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 100, 0.01 * float((sys.argv[2:] or ["0.2"])[0]))
