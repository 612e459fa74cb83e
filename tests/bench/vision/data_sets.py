"""The data sets: distances, label sizes and what spoils the picture."""

from __future__ import annotations

import zlib
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from drivers.camera import CameraModel
from tests.bench.vision import scenes
from tests.bench.vision.scenes import Scene, Spoil, plain_scene

RANGES_MM = ((110.0, 160.0), (160.0, 300.0), (300.0, 600.0))
SIZES_MM = (40.0, 60.0, 80.0)


@dataclass(frozen=True, slots=True)
class DataSet:
    """Pictures of one kind.

    Attributes:
        group: "nominal", "hard" (what the figures of merit are stated for), "damaged", or
            "wrong size", which no single picture can tell.
        name: What is special about it.
        range_mm: Distances.
        size_mm: Side of the code.
        spoil: What happens to the scene.
    """

    group: str
    name: str
    range_mm: tuple[float, float]
    size_mm: float = 60.0
    spoil: Spoil | None = None

    def scenes(
        self, camera: CameraModel, count: int, first: int = 0
    ) -> Iterator[tuple[Scene, tuple[int, ...]]]:
        """Scenes with the seeds of their pictures; the same ones every time.

        Args:
            camera: Takes the pictures.
            count: How many.
            first: Number of the first, so that a set can be run in pieces, or on pictures that
                nobody has seen yet.
        """
        base = zlib.crc32(f"{self.name} {self.range_mm} {self.size_mm}".encode())
        nearest = max(self.range_mm[0], 1.95 * self.size_mm)  # nearer it is not wholly in view
        for number in range(first, first + count):
            rng = np.random.default_rng((base, number))
            scene = plain_scene(camera, rng, nearest, self.range_mm[1], self.size_mm)
            if self.spoil is not None:
                scene = self.spoil(scene, rng)
            yield scene, (base, number, 1)


WHOLE = (115.0, 600.0)
NOMINAL = tuple(
    DataSet("nominal", f"{size:.0f} mm label", range_mm, size)
    for size in SIZES_MM
    for range_mm in RANGES_MM
)
HARD = (
    DataSet("hard", "motion 1-5 px", WHOLE, spoil=scenes.moving),
    DataSet("hard", "glare", WHOLE, spoil=scenes.glaring),
    DataSet("hard", "JPEG 70", WHOLE, spoil=scenes.compressed),
    DataSet("hard", "motion, glare, JPEG", WHOLE, spoil=scenes.hard),
)
DAMAGED = (
    DataSet("damaged", "out of focus", WHOLE, spoil=scenes.unfocused),
    DataSet("damaged", "little light", WHOLE, spoil=scenes.dim),
    DataSet("damaged", "dirt", WHOLE, spoil=scenes.muddy),
    DataSet("damaged", "partly covered", WHOLE, spoil=scenes.partly_covered),
    DataSet("damaged", "a corner lifted", WHOLE, spoil=scenes.lifted),
    DataSet("damaged", "bowed", WHOLE, spoil=scenes.bowed),
    DataSet("damaged", "other codes in view", WHOLE, spoil=scenes.accompanied),
)
WRONG_SIZE = (DataSet("wrong size", "printed 3% small", WHOLE, spoil=scenes.misprinted),)
ALL = NOMINAL + HARD + DAMAGED + WRONG_SIZE
