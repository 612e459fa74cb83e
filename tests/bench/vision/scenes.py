"""Scenes of the data set: where the label is, what happened to it, and how it is photographed."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.vision.markers.april_tags import tag_modules
from server.vision.projection import Array, project, rotation_matrix
from tests.support.label_pictures import Image, Placed, photograph
from tests.support.label_prints import Print, covered, dirty, pasted_over, printed
from tests.support.picture_taking import Shot
from twin.qr_label import label_modules

PAYLOAD = "PLUGPILOT:1:7F3K22Q9"
TAG = "tag36h11:17"
MOST_TILT_DEG = 10.0
_BORDER_PX = 14.0


def camera_720p() -> CameraModel:
    """1280 x 720, 62.2 degrees, off its centre and distorted a little in every way."""
    focal_px = 640 / math.tan(math.radians(31.1))
    return CameraModel(
        width=1280, height=720, fx=focal_px, fy=focal_px, cx=642.7, cy=357.4,
        k1=-0.03, k2=0.02, p1=1e-4, p2=-1e-4,
    )  # fmt: skip


@dataclass(frozen=True, slots=True, eq=False)
class Scene:
    """One label before the camera and one shot of it.

    Attributes:
        label: The QR label as it is.
        tag: A tag label of the same size that suffered the same.
        pose: T_camera_label, the truth, shape (4, 4) [mm].
        shot: Light, blur and sensor.
        lift_mm: How far a corner of the paper has come loose ...
        crease: ... from where on, as of ``Placed``.
        bow_mm: How far two borders of the paper stand off.
        luminous: Light of its own, of a telephone's screen.
        others: What else hangs there.
    """

    label: Print
    tag: Print
    pose: Array
    shot: Shot
    lift_mm: float = 0.0
    crease: float = 0.4
    bow_mm: float = 0.0
    luminous: float = 0.0
    others: tuple[Placed, ...] = field(default=())

    def picture(self, camera: CameraModel, seed: tuple[int, ...], *, tag: bool = False) -> Image:
        """Photograph the QR label, or the tag label at the same place in the same way."""
        label = self.tag if tag else self.label
        own = Placed(
            label, self.pose, self.lift_mm, self.crease, self.bow_mm, luminous=self.luminous
        )
        return photograph(camera, (*self.others, own), self.shot, np.random.default_rng(seed))


Spoil = Callable[[Scene, np.random.Generator], Scene]


@lru_cache(maxsize=8)
def own_modules(payload: str = PAYLOAD) -> NDArray[np.bool_]:
    return label_modules(payload)


def plain_scene(
    camera: CameraModel,
    rng: np.random.Generator,
    nearest_mm: float,
    farthest_mm: float,
    size_mm: float,
) -> Scene:
    """A clean label somewhere in the picture, tilted a little, any side up."""
    ink = float(rng.uniform(-0.03, 0.08))
    shot = Shot(
        blur_px=0.0,
        exposure=float(rng.uniform(0.6, 0.95)),
        gradient=(float(rng.uniform(-0.3, 0.3)), float(rng.uniform(-0.3, 0.3))),
        sharpening=float(rng.choice((0.0, 0.4))),
    )
    pose = random_pose(camera, rng, nearest_mm, farthest_mm, size_mm)
    return Scene(
        label=printed(own_modules(), size_mm, ink_modules=ink),
        tag=printed(tag_modules(TAG), size_mm, ink_modules=ink),
        pose=pose,
        shot=replace(shot, blur_px=focus_blur_px(float(pose[2, 3]))),
    )


def focus_blur_px(distance_mm: float, focus_mm: float = 360.0) -> float:
    """Blur of a lens of 3.04 mm at f/2 on pixels of 2.9 um, focused at a distance."""
    disc_mm = 1.52 * 3.04 * abs(1 / distance_mm - 1 / focus_mm)
    return math.hypot(0.6, disc_mm / 0.00287 / 4)


def random_pose(
    camera: CameraModel,
    rng: np.random.Generator,
    nearest_mm: float,
    farthest_mm: float,
    size_mm: float,
) -> Array:
    """A pose whose whole code lies in the picture, a little way from its border."""
    half = size_mm / 2
    corners = np.array([(-half, -half), (half, -half), (half, half), (-half, half)])
    limit = np.array((camera.width, camera.height)) - 1 - _BORDER_PX
    while True:
        pose = np.eye(4)
        tilt = np.radians(rng.uniform(-MOST_TILT_DEG, MOST_TILT_DEG, 3) / (1, 1, 0.7))
        turn = rotation_matrix(np.array((0, 0, tilt[2] + math.pi * rng.integers(2))))
        pose[:3, :3] = rotation_matrix(np.array((*tilt[:2], 0))) @ turn
        z = rng.uniform(nearest_mm, farthest_mm)
        pose[:3, 3] = (*(rng.uniform(-0.5, 0.5, 2) * (1.1, 0.6) * z), z)
        pixels = project(camera, pose, corners).pixels
        if np.all(pixels > _BORDER_PX) and np.all(pixels < limit):
            return pose


def moving(scene: Scene, rng: np.random.Generator) -> Scene:
    """The picture moves by 1 to 5 pixels during the exposure."""
    angle, way = rng.uniform(0, 2 * math.pi), rng.uniform(1, 5)
    motion = (float(way * math.cos(angle)), float(way * math.sin(angle)))
    return replace(scene, shot=replace(scene.shot, motion_px=motion))


def glaring(scene: Scene, rng: np.random.Generator) -> Scene:
    """One or two lamps are reflected on or beside the label; the middle may be clipped."""
    camera = camera_720p()
    middle = project(camera, scene.pose, np.zeros((1, 2))).pixels[0] / (1280, 720)
    spots = []
    for _ in range(int(rng.integers(1, 3))):
        u, v = middle + rng.normal(0, 0.12, 2)
        spots.append((float(u), float(v), rng.uniform(0.05, 0.25), rng.uniform(0.1, 0.5)))
    return replace(scene, shot=replace(scene.shot, glare=tuple(spots)))


def compressed(scene: Scene, rng: np.random.Generator) -> Scene:
    """JPEG of quality 70."""
    del rng
    return replace(scene, shot=replace(scene.shot, jpeg=70))


def hard(scene: Scene, rng: np.random.Generator) -> Scene:
    """Motion, glare and compression together."""
    return compressed(glaring(moving(scene, rng), rng), rng)


def unfocused(scene: Scene, rng: np.random.Generator) -> Scene:
    """The focus slipped to 140 mm or to 1200 mm."""
    blur = focus_blur_px(float(scene.pose[2, 3]), float(rng.choice((140.0, 1200.0))))
    return replace(scene, shot=replace(scene.shot, blur_px=blur))


def muddy(scene: Scene, rng: np.random.Generator) -> Scene:
    """Up to 40 splashes and a veil."""
    spots, seed = int(rng.integers(5, 40)), int(rng.integers(1 << 30))
    both = [dirty(kind, np.random.default_rng(seed), spots) for kind in (scene.label, scene.tag)]
    return replace(scene, label=both[0], tag=both[1])


def partly_covered(scene: Scene, rng: np.random.Generator) -> Scene:
    """Something lies over up to a tenth of the code, from one side."""
    share, seed = float(rng.uniform(0.0, 0.1)), int(rng.integers(1 << 30))
    both = [covered(kind, np.random.default_rng(seed), share) for kind in (scene.label, scene.tag)]
    return replace(scene, label=both[0], tag=both[1])


def dim(scene: Scene, rng: np.random.Generator) -> Scene:
    """A hundredth to a tenth of the light, with gain: few electrons, much noise."""
    light = float(10 ** rng.uniform(-2.0, -1.0))
    shot = replace(scene.shot, full_well=5000 * light, read_noise=0.0015 / light)
    return replace(scene, shot=shot)


def lifted(scene: Scene, rng: np.random.Generator) -> Scene:
    """A corner of the paper has come loose by up to 2 mm, along a crease somewhere."""
    lift_mm, crease = float(rng.uniform(0.1, 2.0)), float(rng.uniform(-0.3, 1.0))
    return replace(scene, lift_mm=lift_mm, crease=crease)


def bowed(scene: Scene, rng: np.random.Generator) -> Scene:
    """The borders of the paper stand off, or its middle does, by up to a millimetre."""
    return replace(scene, bow_mm=float(rng.uniform(-1.0, 1.0)))


def misprinted(scene: Scene, rng: np.random.Generator) -> Scene:
    """Printed 3 percent too small ("fit to page")."""
    del rng
    small = [replace(kind, size_mm=0.97 * kind.size_mm) for kind in (scene.label, scene.tag)]
    return replace(scene, label=small[0], tag=small[1])


def on_a_telephone(scene: Scene, rng: np.random.Generator) -> Scene:
    """A photograph of the label on a bright screen, in any size."""
    scale = float(rng.uniform(0.45, 1.1))
    shown = [replace(kind, size_mm=scale * kind.size_mm) for kind in (scene.label, scene.tag)]
    bright = float(rng.uniform(0.05, 0.4))
    return replace(scene, label=shown[0], tag=shown[1], luminous=bright)


def accompanied(scene: Scene, rng: np.random.Generator) -> Scene:
    """Another label and an advertisement hang beside it, one of them larger."""
    others: list[Placed] = []
    for text in ("PLUGPILOT:1:OTHER", "https://example.org/parking?lot=17"):
        size = float(rng.uniform(0.5, 1.2)) * scene.label.size_mm
        pose = scene.pose.copy()
        side = 1.0 if others else -1.0
        reach = 0.72 * (scene.label.side_mm + size * 1.4)
        pose[:3, 3] += pose[:3, 0] * side * reach
        others.append(Placed(printed(own_modules(text), size), pose))
    return replace(scene, others=tuple(others))


def overpasted(scene: Scene, rng: np.random.Generator) -> Scene:
    """Another car's label sticks over a part of it."""
    other = printed(own_modules("PLUGPILOT:1:7F3K22Q8"), scene.label.size_mm)
    share = float(rng.uniform(0.1, 0.5))
    return replace(scene, label=pasted_over(scene.label, other, rng, share))
