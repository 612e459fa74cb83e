"""Guidance as the server would send it, from the real decision on made-up cars."""

from __future__ import annotations

import math

import numpy as np

from server.config.settings import Settings
from server.guidance.advice import Adviser
from server.guidance.model import CarEstimate, Direction, PauseReason, Unseen
from server.guidance.reach import Reach
from server.guidance.view import view_of
from server.guidance.guide import Guidance as Guided
from server.schema.guidance import Guidance
from server.timing import Calendar
from tests.browser.scenes import NOW


class FixedCalendar(Calendar):
    """Dates that do not pass."""

    def __init__(self) -> None:
        pass

    def at(self, loop_time_s: float):
        del loop_time_s
        return NOW


SETTINGS = Settings()
REACH = Reach(SETTINGS.geometry, SETTINGS.insertion, SETTINGS.guidance)


def car(
    x_mm: float,
    z_mm: float,
    *,
    speed_mm_s: float = 0.0,
    sigma_mm: float = 1.0,
    turned_deg: float = 0.6,
    skew_sigma_deg: float = 0.25,
) -> CarEstimate:
    """A car whose socket is there, at a height that the robot likes."""
    return CarEstimate(
        at_s=0.0,
        vehicle_id="zoe",
        place_mm=np.array([x_mm, REACH.middle_y_mm, z_mm]),
        covariance_mm2=np.diag([sigma_mm**2, sigma_mm**2, (2.5 * sigma_mm) ** 2]),
        velocity_mm_s=np.array([0.0, 0.0, -speed_mm_s]),
        braking_mm_s2=0.0,
        still=speed_mm_s == 0,
        skew_rad=math.radians(abs(turned_deg)),
        skew_sigma_rad=math.radians(skew_sigma_deg),
        turned_rad=math.radians(turned_deg),
        distance_mm=z_mm + 50,
        flawed=False,
    )


def scene(estimate: CarEstimate | None, **kind: object) -> Guidance:
    """What the page is sent about it."""
    limit = math.radians(SETTINGS.insertion.max_tilt_deg)
    adviser = Adviser(REACH, SETTINGS.guidance, limit, 0.0)
    for now_s in (0.0, 10.0):
        if estimate is not None:
            adviser.advise(estimate, now_s)
        elif "lost" in kind:
            adviser.lose(kind["lost"], now_s)
        elif "unseen" in kind:
            adviser.miss(kind["unseen"], now_s)
        elif "paused" in kind:
            adviser.pause(kind["paused"], now_s)
    guided = Guided(adviser.advice, estimate, None, arriving=True, looked_at_s=0.0)
    return view_of(guided, REACH, SETTINGS, FixedCalendar())


SCENES: dict[str, Guidance] = {
    "far": scene(car(690, 1120, speed_mm_s=380, sigma_mm=4, skew_sigma_deg=1.8, turned_deg=-2)),
    "near": scene(car(668, 460, speed_mm_s=110, sigma_mm=1.6)),
    "aside": scene(car(805, 420, speed_mm_s=90, sigma_mm=1.4, turned_deg=4)),
    "stop": scene(car(652, 305, speed_mm_s=120, sigma_mm=1.1)),
    "good": scene(car(652, 239)),
    "thin": scene(car(747, 241)),
    "short": scene(car(640, 288)),
    "deep": scene(car(640, 212)),
    "skewed": scene(car(655, 240, turned_deg=5.4)),
    "lost": scene(None, lost=Direction.RIGHT),
    "hidden": scene(None, lost=None),
    "dirty": scene(None, unseen=Unseen.TOO_DIRTY),
    "waiting": scene(None, unseen=Unseen.NOTHING),
    "not_parked": scene(None, paused=PauseReason.ROBOT_NOT_PARKED),
    "camera_down": scene(None, paused=PauseReason.CAMERA_DOWN),
}
