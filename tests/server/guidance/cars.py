"""Made-up sightings and cars for tests of the decision."""

from __future__ import annotations

import math

import numpy as np

from server.config.settings import Settings
from server.guidance.model import CarEstimate, Sighting
from server.guidance.reach import Reach

SETTINGS = Settings()
REACH = Reach(SETTINGS.geometry, SETTINGS.insertion, SETTINGS.guidance)
LIMIT_RAD = math.radians(SETTINGS.insertion.max_tilt_deg)
MIDDLE_X_MM = SETTINGS.geometry.regular_box.center_x_mm
CAMERA_MM = np.array([736.0, 320.0, -50.0])


def estimate(
    x_mm: float = MIDDLE_X_MM,
    z_mm: float | None = None,
    y_mm: float | None = None,
    *,
    speed_mm_s: float = 0.0,
    braking_mm_s2: float = 0.0,
    skew_deg: float = 0.5,
    skew_sigma_deg: float = 0.2,
    turned_deg: float = 0.0,
    sigma_mm: float = 0.5,
    flawed: bool = False,
    faces_robot: bool = True,
) -> CarEstimate:
    """A car, by default standing in the best place."""
    place = [
        x_mm,
        REACH.middle_y_mm if y_mm is None else y_mm,
        REACH.stop_z_mm if z_mm is None else z_mm,
    ]
    return CarEstimate(
        at_s=0.0,
        vehicle_id="zoe",
        place_mm=np.array(place),
        covariance_mm2=sigma_mm**2 * np.eye(3),
        velocity_mm_s=np.array([0.0, 0.0, -speed_mm_s]),
        braking_mm_s2=braking_mm_s2,
        still=speed_mm_s == 0,
        skew_rad=math.radians(skew_deg),
        skew_sigma_rad=math.radians(skew_sigma_deg),
        turned_rad=math.radians(turned_deg),
        distance_mm=300.0,
        flawed=flawed,
        faces_robot=faces_robot,
    )


def sighting(
    at_s: float,
    place_mm: np.ndarray,
    *,
    sigma_mm: float = 0.05,
    lean: tuple[float, float] = (0.0, 0.0),
    lean_sigma_rad: float = 0.001,
    vehicle_id: str = "zoe",
    faces_robot: bool | None = None,
) -> Sighting:
    """The socket in one picture."""
    pose = np.eye(4)
    pose[:3, 3] = place_mm + np.array([120.0, 0.0, 0.0])
    return Sighting(
        at_s=at_s,
        vehicle_id=vehicle_id,
        T_base_label=pose,
        place_mm=np.array(place_mm, dtype=np.float64),
        covariance_mm2=sigma_mm**2 * np.eye(3),
        lean=np.array(lean),
        lean_covariance=lean_sigma_rad**2 * np.eye(2),
        from_camera_mm=pose[:3, 3] - CAMERA_MM,
        faces_robot=faces_robot,
    )
