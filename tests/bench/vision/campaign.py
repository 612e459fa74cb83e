"""Many pictures of all kinds, good and bad: is a wrong pose ever accepted as good?

Run as ``python -m tests.bench.vision.campaign [--frames N] [--first K] [--kind NAME]``. A pose is
wrong when it was accepted although it is off by more than 0.5 mm sideways, 1% of the distance or 2
degrees of tilt, or when there was nothing to locate. Every frame follows from its number, so a
campaign can be run in pieces, a wrong pose be looked at again, and one kind be searched widely. A
label in a wrong size (printed, or on a telephone) is measured against its nominal size times the
true scale, because one picture cannot tell the size.
"""

from __future__ import annotations

import argparse
import math
from collections import Counter, defaultdict
from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import count, islice

import cv2
import numpy as np
from threadpoolctl import threadpool_limits

from drivers.camera import CameraModel
from server.vision import Locator, VisionError
from server.vision.projection import Array, perturbed, rotation_vector
from tests.bench.vision import scenes
from tests.bench.vision.scenes import PAYLOAD, Scene, plain_scene
from tests.support.label_pictures import Image
from tests.support.label_prints import mirrored, printed

LATERAL_MM, DEPTH_SHARE, TILT_DEG = 0.5, 0.01, 2.0


@dataclass(frozen=True, slots=True)
class Kind:
    """One kind of picture.

    Attributes:
        change: What happens to the plain scene.
        expected: The text asked for; None takes any code.
        locatable: Whether a pose may be accepted at all.
    """

    change: Callable[[Scene, np.random.Generator], Scene]
    expected: str | None = PAYLOAD
    locatable: bool = True


def foreign(scene: Scene, rng: np.random.Generator) -> Scene:
    """A code from elsewhere, of any version."""
    text = "https://example.org/" + "x" * int(rng.integers(0, 60))
    return replace(scene, label=printed(scenes.own_modules(text), scene.label.size_mm))


def in_a_mirror(scene: Scene, rng: np.random.Generator) -> Scene:
    del rng
    return replace(scene, label=mirrored(scene.label))


def twice(scene: Scene, rng: np.random.Generator) -> Scene:
    """A copy of the label hangs beside it, sometimes out of the picture."""
    spoiled = scenes.accompanied(scene, rng)
    copy = replace(spoiled.others[0], label=scene.label)
    return replace(spoiled, others=(copy,))


def ruined(scene: Scene, rng: np.random.Generator) -> Scene:
    """Several things at once."""
    ways = (scenes.hard, scenes.muddy, scenes.partly_covered, scenes.dim, scenes.lifted)
    for number in rng.choice(len(ways), size=3, replace=False):
        scene = ways[number](scene, rng)
    return scene


def curled(scene: Scene, rng: np.random.Generator) -> Scene:
    """A corner has come far off."""
    return replace(scene, lift_mm=float(rng.uniform(2.0, 25.0)))


def oblique(scene: Scene, rng: np.random.Generator) -> Scene:
    """Seen from the side."""
    turn = np.array([*rng.uniform(-1.0, 1.0, 2), 0.0, 0.0, 0.0, 0.0])
    return replace(scene, pose=perturbed(scene.pose, turn))


KINDS = {
    "plain": Kind(lambda scene, _: scene),
    "hard": Kind(scenes.hard),
    "motion": Kind(scenes.moving),
    "glare": Kind(scenes.glaring),
    "out of focus": Kind(scenes.unfocused),
    "little light": Kind(scenes.dim),
    "dirt": Kind(scenes.muddy),
    "partly covered": Kind(scenes.partly_covered),
    "corner lifted": Kind(scenes.lifted),
    "curled": Kind(curled),
    "pasted over": Kind(scenes.overpasted),
    "bowed": Kind(scenes.bowed),
    "on a telephone": Kind(scenes.on_a_telephone),
    "printed small": Kind(scenes.misprinted),
    "several at once": Kind(ruined),
    "oblique": Kind(oblique),
    "other codes beside": Kind(scenes.accompanied),
    "foreign code": Kind(foreign, expected=None),
    "wrong label": Kind(foreign, locatable=False),
    "mirrored": Kind(in_a_mirror, locatable=False),
    "label twice": Kind(twice),
}


@dataclass(frozen=True, slots=True, eq=False)
class Frame:
    """One frame of the campaign.

    Attributes:
        kind: Name of its kind.
        size_mm: Side of the code that the locator is told.
        scene: What is before the camera.
        image: Its picture.
        predicted: T_camera_label as a robot may expect it, shape (4, 4) [mm]; None in every other
            row of kinds.
    """

    kind: str
    size_mm: float
    scene: Scene
    image: Image
    predicted: Array | None


def frame(number: int, camera: CameraModel) -> Frame:
    """The frame of a number, the same one every time."""
    rng = np.random.default_rng((77, number))
    kind = kind_of(number)
    size_mm = float(rng.choice((40.0, 60.0, 80.0), p=(0.25, 0.5, 0.25)))
    scene = plain_scene(camera, rng, max(110.0, 1.95 * size_mm), 600.0, size_mm)
    scene = KINDS[kind].change(scene, rng)
    image = scene.picture(camera, (77, number, 1))
    predicted = None
    if number // len(KINDS) % 2:  # every other frame comes with one, which may be quite wrong
        spread = np.array([0.05, 0.05, 0.03, 3.0, 3.0, 8.0]) * rng.choice((0.1, 1.0))
        predicted = perturbed(scene.pose, rng.normal(0, spread))
    return Frame(kind, size_mm, scene, image, predicted)


def kind_of(number: int) -> str:
    """Name of a frame's kind."""
    return list(KINDS)[number % len(KINDS)]


def run(frames: int, first: int, only: str | None = None) -> bool:
    """Run the campaign and print its table; returns whether no wrong pose was accepted.

    Args:
        frames: How many.
        first: Number of the first.
        only: Leave out all kinds but this one.
    """
    camera = scenes.camera_720p()
    locator = Locator(camera)
    ends: dict[str, Counter[str]] = defaultdict(Counter)
    wrong = 0
    numbers = (number for number in count(first) if only in {None, kind_of(number)})
    for number in islice(numbers, frames):
        taken = frame(number, camera)
        end, fault = _judge(locator, taken)
        ends[taken.kind][end] += 1
        if fault is not None:
            wrong += 1
            print(f"frame {number} ({taken.kind}): {fault}", flush=True)
    _print(ends)
    print(f"{frames} frames from {first} on: {wrong} wrong poses accepted as good")
    return wrong == 0


def _judge(locator: Locator, taken: Frame) -> tuple[str, str | None]:
    """How locating ended, and what is wrong with it."""
    kind, scene = KINDS[taken.kind], taken.scene
    try:
        found = locator.locate(
            taken.image,
            label_size_mm=taken.size_mm,
            expected_payload=kind.expected,
            predicted=taken.predicted,
        )
    except VisionError as error:
        return error.code, None
    if not kind.locatable:
        return "located", "there was nothing to locate"
    true = scene.pose.copy()
    true[:3, 3] *= taken.size_mm / scene.label.size_mm  # a smaller print looks farther away
    shift = found.T_camera_label[:3, 3] - true[:3, 3]
    turn = rotation_vector(found.T_camera_label[:3, :3] @ true[:3, :3].T)
    lateral, depth = float(np.hypot(shift[0], shift[1])), abs(float(shift[2]))
    tilt = math.degrees(float(np.linalg.norm(turn)))
    if lateral > LATERAL_MM or depth > DEPTH_SHARE * true[2, 3] or tilt > TILT_DEG:
        return "located", f"off by {lateral:.2f} mm sideways, {depth:.2f} mm deep, {tilt:.2f} deg"
    return "located", None


def _print(ends: dict[str, Counter[str]]) -> None:
    for name, counts in ends.items():
        total = sum(counts.values())
        rest = ", ".join(f"{code} {count}" for code, count in counts.most_common())
        print(f"{name:20} {total:5}  {rest}")


def main() -> None:
    """Read the arguments and run."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--frames", type=int, default=1000)
    parser.add_argument("--first", type=int, default=0, help="number of the first frame")
    parser.add_argument("--kind", choices=KINDS, help="only frames of this kind")
    arguments = parser.parse_args()
    cv2.setNumThreads(1)
    threadpool_limits(1, "blas")
    if not run(arguments.frames, arguments.first, arguments.kind):
        raise SystemExit(1)


if __name__ == "__main__":
    main()
