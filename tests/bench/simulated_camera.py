"""How long the simulated camera computes for a picture, and what its scenes look like.

Run with ``python -m tests.bench.simulated_camera``; ``--pictures DIRECTORY`` draws every scene of
the camera's README instead. Times are those of one thread's processor, so that other programs on
the machine disturb them little.
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path

import cv2
import numpy as np

from drivers.camera import pi_camera_v2
from drivers.simulator.camera.conditions import FLAWLESS, Conditions
from drivers.simulator.camera.imaging import ImagingParameters
from drivers.simulator.camera.renderer import Renderer
from drivers.simulator.view import CameraView
from tests.drivers.simulator.camera.scenes import everything, pose, scenes, view

PICTURES = 60
WANTED_PER_S = 20.0
GLOBAL_SHUTTER = ImagingParameters(readout_s=0.0)


def standing(number: int) -> CameraView:
    """The robot waits: every picture shows the same scene."""
    del number
    return view(pose(2.0, -15.0, 280.0, (0.01, -0.02, 0.015)), plug=_PLUG)


def moving(number: int) -> CameraView:
    """The robot passes the label at 80 mm/s."""
    x = 80.0 * (number % 30 - 15) / 30
    label = pose(x, -15.0, 280.0, (0.01, -0.02, 0.015))
    return view(label, velocity_mm_s=(80.0, 10.0, 0.0), plug=_PLUG)


_PLUG = pose(112.0, -32.0, 215.0)

CASES: dict[str, tuple[ImagingParameters, Conditions]] = {
    "every effect off": (GLOBAL_SHUTTER, FLAWLESS),
    "ordinary garage": (ImagingParameters(), Conditions()),
    "every effect on": everything(),
}


def milliseconds(renderer: Renderer, *, still: bool) -> np.ndarray:
    """Processor time of each of many pictures, shape (PICTURES,)."""
    scene = standing if still else moving
    for number in range(3):
        renderer.picture(scene(number), number)
    times = []
    for number in range(PICTURES):
        seen = scene(number)
        began_s = time.process_time()
        renderer.picture(seen, number)
        times.append(1e3 * (time.process_time() - began_s))
    return np.array(times)


def draw_scenes(directory: Path) -> None:
    """Write a picture of every scene, at rest and in motion."""
    directory.mkdir(parents=True, exist_ok=True)
    for heading, parameters in scenes().items():
        renderer = Renderer(pi_camera_v2(), parameters.imaging, 3, parameters.conditions)
        name = "-".join(heading.lower().replace(",", "").replace("'", "").split())
        cv2.imwrite(str(directory / f"{name}.png"), renderer.picture(standing(0), 0))
    renderer = Renderer(pi_camera_v2(), ImagingParameters(), 3, Conditions())
    cv2.imwrite(str(directory / "passing-at-80-mm-s.png"), renderer.picture(moving(10), 0))


def main() -> None:
    """Print a table, or write pictures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--pictures", type=Path, help="write a picture of every scene there")
    directory = parser.parse_args().pictures
    cv2.setNumThreads(1)
    if directory is not None:
        draw_scenes(directory)
        return
    print(f"1640 x 1232, {PICTURES} pictures each, one thread; wanted: {WANTED_PER_S:g} per s")
    print(f"{'':<28}{'median ms':>10}{'p95 ms':>10}{'pictures/s':>12}")
    for name, (imaging, conditions) in CASES.items():
        renderer = Renderer(pi_camera_v2(), imaging, 3, conditions)
        for still in (True, False):
            taken_ms = milliseconds(renderer, still=still)
            median, p95 = np.percentile(taken_ms, (50, 95))
            what = f"{name}, {'standing' if still else 'moving'}"
            print(f"{what:<28}{median:>10.1f}{p95:>10.1f}{1e3 / median:>12.1f}")


if __name__ == "__main__":
    main()
