"""Guidance as everyone sees it: rounded, with dates instead of event loop times."""

from __future__ import annotations

import math
from typing import Literal

from server.config.settings import Settings
from server.guidance import guide
from server.guidance.advice import Advice
from server.guidance.guide import Guide
from server.guidance.model import CarEstimate
from server.guidance.reach import Reach, Zone
from server.schema.guidance import Guidance, GuidanceStep, GuidanceZones, GuidedCar
from server.timing import Calendar


def guidance_view(source: Guide, settings: Settings, calendar: Calendar) -> Guidance:
    """What the driver is told now."""
    return view_of(source.now, source.reach, settings, calendar)


def view_of(now: guide.Guidance, reach: Reach, settings: Settings, calendar: Calendar) -> Guidance:
    """What is known and said at one instant."""
    advice = now.advice
    return Guidance(
        state=advice.state.value,
        since=calendar.at(advice.since_s),
        arriving=now.arriving,
        reason=advice.words.reason.value,
        headline=advice.words.headline,
        detail=advice.words.detail,
        remedy=advice.words.remedy,
        steps=[
            GuidanceStep(
                direction=step.direction.value,
                distance_mm=round(step.distance_mm, 1),
                shown_cm=step.shown_cm,
            )
            for step in advice.steps
        ],
        car=_car(now.car, advice, calendar) if now.car is not None else None,
        zones=_zones(reach, now.car),
        driver_faces=_driver_faces(now.car, settings),
        max_skew_deg=settings.insertion.max_tilt_deg,
    )


def _driver_faces(car: CarEstimate | None, settings: Settings) -> Literal["robot", "away"]:
    if car is None:
        return settings.guidance.driver_faces
    return "robot" if car.faces_robot else "away"


def _car(car: CarEstimate, advice: Advice, calendar: Calendar) -> GuidedCar:
    x, y, z = (round(float(value), 1) for value in car.place_mm)
    covariance = car.covariance_mm2
    sigma_x, sigma_z = math.sqrt(covariance[0, 0]), math.sqrt(covariance[2, 2])
    return GuidedCar(
        vehicle_id=car.vehicle_id,
        x_mm=x,
        y_mm=y,
        z_mm=z,
        sigma_x_mm=round(sigma_x, 2),
        sigma_z_mm=round(sigma_z, 2),
        correlation_xz=round(float(covariance[0, 2]) / (sigma_x * sigma_z), 3),
        velocity_x_mm_s=round(float(car.velocity_mm_s[0])),
        velocity_z_mm_s=round(float(car.velocity_mm_s[2])),
        still=car.still,
        skew_deg=round(math.degrees(car.skew_rad), 1),
        skew_sigma_deg=round(math.degrees(car.skew_sigma_rad), 2),
        turned_deg=round(math.degrees(car.turned_rad), 1),
        distance_mm=round(car.distance_mm),
        margin_mm=None if advice.margin_mm is None else round(advice.margin_mm, 1),
        seen_at=calendar.at(car.at_s),
    )


def _zones(reach: Reach, car: CarEstimate | None) -> GuidanceZones:
    """At the height of the car's socket, or as if the platform stood in the middle of its reach."""
    height_mm = float(car.place_mm[1]) if car is not None else reach.middle_y_mm

    def outline(zone: Zone) -> list[tuple[float, float]]:
        return [(round(x), round(z)) for x, z in reach.outline(zone, height_mm)]

    return GuidanceZones(
        good=outline(reach.good),
        reachable=outline(reach.reachable),
        stop_z_mm=round(reach.stop_z_mm, 1),
    )
