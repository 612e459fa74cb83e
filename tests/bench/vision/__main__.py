"""Locating the label: the project's locator beside others on the very same frames.

Run as ``python -m tests.bench.vision [--frames N] [--first K] [--quick] [--ours] [--out FOLDER]``.
It prints a table and, with ``--out``, writes it there as vision.md with a plot vision.svg. Times
are processor time of one thread, so other programs on the machine disturb them little, but they do.
The AprilTag library takes part if pupil-apriltags is installed.
"""

from __future__ import annotations

import argparse
import time
from collections import defaultdict
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

import cv2
import numpy as np
from threadpoolctl import threadpool_limits

from drivers.camera import CameraModel, pi_camera_v2
from server.vision import LabelPose, combine
from server.vision.projection import Array
from tests.bench.vision import data_sets
from tests.bench.vision.data_sets import DataSet
from tests.bench.vision.methods import (
    FullLocator,
    Method,
    TrackedLocator,
    compared,
    tag_library,
)
from tests.bench.vision.plot import error_plot
from tests.bench.vision.scenes import camera_720p, plain_scene
from tests.bench.vision.scores import Scores, merged
from tests.bench.vision.table import HEAD, document, row

Result = TypeVar("Result")
FULL, TRACKED, TAG = "PlugPilot", "PlugPilot, tracked", "PlugPilot on AprilTag"
LIBRARY = "AprilTag library + corners"
QUICK_FRAMES = 8


class Bench:
    """Runs all methods on a set of pictures after the other.

    Args:
        camera: Takes the pictures.
        ours: Leave all other methods and the tags out.
    """

    def __init__(self, camera: CameraModel, *, ours: bool = False) -> None:
        self._camera = camera
        self._full = FullLocator(camera)
        self._tracked = TrackedLocator(camera)
        self._tag = None if ours else FullLocator(camera, tag=True)
        self._others = {} if ours else compared(camera)
        self._library = None if ours else tag_library(camera)

    def run(self, data: DataSet, frames: int, first: int = 0) -> dict[str, Scores]:
        """Scores by method, on so many pictures of a set from one number on."""
        scores: dict[str, Scores] = defaultdict(Scores)
        for scene, seed in data.scenes(self._camera, frames, first):
            image = scene.picture(self._camera, seed)
            size_mm, true = data.size_mm, scene.pose
            predicted = self._tracked.predict(true)
            found, time_s = _timed(lambda: self._full(image, size_mm))  # noqa: B023 - called at once
            _add(scores[FULL], found, true, time_s)
            found, time_s = _timed(lambda: self._tracked(image, size_mm, predicted))  # noqa: B023
            _add(scores[TRACKED], found, true, time_s)
            for name, method in self._others.items():
                self._compare(scores[name], method, image, size_mm, true)
            if self._tag is None:
                continue
            tag, tag_image = self._tag, scene.picture(self._camera, seed, tag=True)
            found, time_s = _timed(lambda: tag(tag_image, size_mm))  # noqa: B023
            _add(scores[TAG], found, true, time_s)
            if self._library is not None:
                self._compare(scores[LIBRARY], self._library, tag_image, size_mm, true)
        return scores

    @staticmethod
    def _compare(
        scores: Scores, method: Method, image: cv2.typing.MatLike, size_mm: float, true: Array
    ) -> None:
        pose, time_s = _timed(lambda: method(np.asarray(image, dtype=np.uint8), size_mm))
        scores.add(pose, true, time_s)


def _timed(call: Callable[[], Result]) -> tuple[Result, float]:
    started = time.process_time()
    result = call()
    return result, time.process_time() - started


def _add(scores: Scores, found: LabelPose | None, true: Array, time_s: float) -> None:
    if found is None:
        scores.add(None, true, time_s)
    else:
        scores.add(found.T_camera_label, true, time_s, found.covariance)


def standstill(camera: CameraModel, places: int, pictures: int = 10) -> str:
    """How far the mean of several pictures of one scene stays off, and what it promises."""
    full = FullLocator(camera)
    single, mean = Scores(), Scores()
    for place in range(places):
        scene = plain_scene(camera, np.random.default_rng((17, place)), 260.0, 320.0, 60.0)
        poses = []
        for number in range(pictures):
            found = full(scene.picture(camera, (17, place, number)), 60.0)
            if found is not None:
                poses.append(found)
        _add(single, poses[0], scene.pose, 0.0)
        _add(mean, combine(poses), scene.pose, 0.0)
    rows = (
        row("standstill", "260-320", "one picture", single),
        row("standstill", "260-320", f"mean of {pictures}", mean),
    )
    return "\n".join(rows)


def full_field(frames: int) -> str:
    """The same on the 1640 x 1232 pictures of the whole sensor."""
    camera = pi_camera_v2()
    full, scores = FullLocator(camera), Scores()
    for number in range(frames):
        scene = plain_scene(camera, np.random.default_rng((23, number)), 115.0, 600.0, 60.0)
        image = scene.picture(camera, (23, number, 1))
        found, time_s = _timed(lambda: full(image, 60.0))  # noqa: B023 - called at once
        _add(scores, found, scene.pose, time_s)
    return row("nominal 1640 x 1232", "115-600", FULL, scores)


def main() -> None:
    """Read the arguments, run, print and write."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--frames", type=int, default=60, help="per set")
    parser.add_argument("--first", type=int, default=0, help="number of each set's first picture")
    parser.add_argument("--ours", action="store_true", help="only this project's locator")
    parser.add_argument("--quick", action="store_true", help=f"only {QUICK_FRAMES} per set")
    parser.add_argument("--out", type=Path, help="folder for vision.md and vision.svg")
    arguments = parser.parse_args()
    frames = QUICK_FRAMES if arguments.quick else arguments.frames
    cv2.setNumThreads(1)
    threadpool_limits(1, "blas")  # as the server does
    camera = camera_720p()
    bench = Bench(camera, ours=arguments.ours)
    rows: list[str] = []
    groups: dict[tuple[str, str], list[Scores]] = defaultdict(list)
    lateral: dict[str, list[tuple[float, float]]] = defaultdict(list)
    depth: dict[str, list[tuple[float, float]]] = defaultdict(list)

    def put(line: str) -> None:
        rows.append(line)
        print(line, flush=True)

    print(HEAD)
    for data in data_sets.ALL:
        scores = bench.run(data, frames, arguments.first)
        nearest, farthest = data.range_mm
        for name, score in scores.items():
            put(row(f"{data.group}: {data.name}", f"{nearest:.0f}-{farthest:.0f}", name, score))
            groups[data.group, name].append(score)
        if data.group == "nominal" and data.size_mm == 60.0:
            for name, score in scores.items():
                lateral[name] += zip(score.ranges_mm, score.lateral_mm.tolist(), strict=True)
                depth[name] += zip(score.ranges_mm, score.depth_mm.tolist(), strict=True)
    for (group, name), parts in groups.items():
        if len(parts) > 1:
            put(row(f"all {group}", "", name, merged(parts)))
    put(full_field(frames))
    put(standstill(camera, max(frames // 4, 3)))
    if arguments.out is not None:
        arguments.out.mkdir(parents=True, exist_ok=True)
        (arguments.out / "vision.md").write_text(document(rows, frames), encoding="utf-8")
        panels = {
            "Error sideways, mm: 60 mm label, nominal": lateral,
            "Error of the depth, mm": depth,
        }
        picture = error_plot(panels)
        (arguments.out / "vision.svg").write_text(picture, encoding="utf-8")


if __name__ == "__main__":
    main()
