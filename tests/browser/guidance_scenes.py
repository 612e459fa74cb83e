"""Guidance as the server would send it, from the real decision on made-up cars."""

from __future__ import annotations

import math
from collections.abc import Callable
from datetime import datetime

import numpy as np

from server.config.settings import Settings
from server.guidance.advice import Advice, Adviser
from server.guidance.guide import Guidance as Guided
from server.guidance.model import CarEstimate, Direction, PauseReason, Unseen
from server.guidance.reach import Reach
from server.guidance.view import view_of
from server.schema.guidance import Guidance
from server.timing import Calendar
from tests.browser.scenes import NOW


class FixedCalendar(Calendar):
    """Dates that do not pass."""

    def __init__(self) -> None:
        pass

    def at(self, loop_time_s: float) -> datetime:
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
        faces_robot=True,
    )


def scene(
    tell: Callable[[Adviser, float], Advice], estimate: CarEstimate | None = None
) -> Guidance:
    """What the page is sent after something has been so for a while."""
    adviser = Adviser(REACH, SETTINGS.guidance, math.radians(SETTINGS.insertion.max_tilt_deg), 0.0)
    for now_s in (0.0, 10.0):
        tell(adviser, now_s)
    guided = Guided(adviser.advice, estimate, None, arriving=True, looked_at_s=0.0)
    return view_of(guided, REACH, SETTINGS, FixedCalendar())


def of_car(estimate: CarEstimate) -> Guidance:
    """There is a car."""
    return scene(lambda adviser, now_s: adviser.advise(estimate, now_s), estimate)


def lost(edge: Direction | None) -> Guidance:
    """There was one."""
    return scene(lambda adviser, now_s: adviser.lose(edge, now_s))


def missed(why: Unseen) -> Guidance:
    """There is none that could be made out."""
    return scene(lambda adviser, now_s: adviser.miss(why, now_s))


def paused(reason: PauseReason) -> Guidance:
    """There is no guidance."""
    return scene(lambda adviser, now_s: adviser.pause(reason, now_s))


SCENES: dict[str, Guidance] = {
    "far": of_car(car(690, 1120, speed_mm_s=380, sigma_mm=4, skew_sigma_deg=1.8, turned_deg=-2)),
    "near": of_car(car(668, 460, speed_mm_s=110, sigma_mm=1.6)),
    "aside": of_car(car(805, 420, speed_mm_s=90, sigma_mm=1.4, turned_deg=4)),
    "stop": of_car(car(652, 305, speed_mm_s=120, sigma_mm=1.1)),
    "good": of_car(car(652, 239)),
    "thin": of_car(car(747, 241)),
    "short": of_car(car(640, 288)),
    "deep": of_car(car(640, 212)),
    "skewed": of_car(car(655, 240, turned_deg=5.4)),
    "lost": lost(Direction.RIGHT),
    "hidden": lost(None),
    "dirty": missed(Unseen.TOO_DIRTY),
    "waiting": missed(Unseen.NOTHING),
    "not_parked": paused(PauseReason.ROBOT_NOT_PARKED),
    "camera_down": paused(PauseReason.CAMERA_DOWN),
}
