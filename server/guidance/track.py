"""Follows a car through its sightings: a Kalman filter, and whether it stands.

The place p and the velocity v of the socket follow p' = v, v' = white noise whose strength is what
drivers do to a car (Y. Bar-Shalom, X. R. Li, T. Kirubarajan, Estimation with Applications to
Tracking and Navigation, 2001, 6.2). What all pictures of a camera have in common, a wrong focal
length or print size, does not average out: it is added to the covariance at the end.
"""

from __future__ import annotations

import math
from collections import deque

import numpy as np

from server.config.guidance import GuidanceSettings
from server.guidance.model import Array, CarEstimate, Sighting

CAR_MM_S2 = np.array([250.0, 120.0, 900.0])
"""Accelerations along x, y, z that are usual: steering, springs, pedals."""

FIRST_SPEED_MM_S = 800.0
PICTURE_SIGMA_MM = 0.1
"""Of a place, however sure the fit: a bowed label, a rolling shutter."""

SCALE_SIGMA = 0.003
"""Of the distance: focal length or print size off by 0.3%."""

ASIDE_SIGMA = 0.0025
"""Of the distance: principal point off by 2 px, camera turned in its mount."""

ROBOT_SIGMA_MM = 0.5
LEAN_SIGMA = math.radians(0.2)
"""Of the tilt: a label that is bowed by 0.3 mm."""

MOVING_LEAN_SIGMA = math.radians(1.0)
SHEAR_S = 0.005
"""A rolling shutter reads a near label within this time; its motion then looks like a tilt."""

ROW_S = 0.006
"""And the label is seen so long before or after the middle of the picture."""

_LABEL_MM = 60.0

OTHER_CAR = 30.0
"""Squared distance in standard deviations from which a sighting belongs to another motion."""

BRAKING_S = 0.45
"""Over which the deceleration is averaged."""

_LEAST_STILL, _LEAST_SPEEDS = 3, 3


class CarTrack:
    """One car, from its first sighting on.

    Args:
        first: The first sighting.
        settings: When a car stands.
    """

    def __init__(self, first: Sighting, settings: GuidanceSettings) -> None:
        self._settings = settings
        self._begin(first)

    def _begin(self, first: Sighting) -> None:
        self._state = np.concatenate((first.place_mm, np.zeros(3)))
        self._covariance = np.zeros((6, 6))
        self._covariance[:3, :3] = _noise(first)
        self._covariance[3:, 3:] = FIRST_SPEED_MM_S**2 * np.eye(3)
        self._last = first
        self._recent: deque[Sighting] = deque([first])
        self._speeds: deque[tuple[float, float]] = deque()
        self._travelled_mm = 0.0

    @property
    def last(self) -> Sighting:
        """The newest sighting."""
        return self._last

    @property
    def faces_robot(self) -> bool:
        """Whether the driver sits with the face to the robot."""
        of_vehicle = self._last.faces_robot
        return self._settings.driver_faces == "robot" if of_vehicle is None else of_vehicle

    @property
    def travelled_mm(self) -> float:
        """How far it has come while it was seen."""
        return self._travelled_mm

    def take(self, sighting: Sighting) -> None:
        """Take in a sighting; one that is not newer changes nothing."""
        elapsed_s = sighting.at_s - self._last.at_s
        if elapsed_s <= 0:
            return
        state, covariance = self._predicted(elapsed_s)
        noise = _noise(sighting) + (ROW_S * np.linalg.norm(self._state[3:])) ** 2 * np.eye(3)
        innovation = sighting.place_mm - state[:3]
        spread = covariance[:3, :3] + noise
        if float(innovation @ np.linalg.solve(spread, innovation)) > OTHER_CAR:
            self._begin(sighting)
            return
        gain = np.linalg.solve(spread, covariance[:3]).T
        before = self._state[:3].copy()
        self._state = state + gain @ innovation
        rest = np.eye(6)
        rest[:, :3] -= gain
        # Joseph's form keeps it symmetric and positive
        self._covariance = rest @ covariance @ rest.T + gain @ noise @ gain.T
        self._travelled_mm += float(np.linalg.norm((self._state[:3] - before)[[0, 2]]))
        self._last = sighting
        self._speeds.append((sighting.at_s, -float(self._state[5])))
        while self._speeds[0][0] < sighting.at_s - BRAKING_S:
            self._speeds.popleft()
        self._recent.append(sighting)
        while len(self._recent) > _LEAST_STILL and (
            sighting.at_s - self._recent[1].at_s >= self._settings.still_s
        ):
            self._recent.popleft()

    def place_at(self, t_s: float) -> Array:
        """Where the socket is expected, shape (3,) [mm]."""
        return np.asarray(self._state[:3] + self._state[3:] * (t_s - self._last.at_s))

    def label_at(self, t_s: float) -> Array:
        """T_base_label as it is expected: turned as it was seen last, shape (4, 4)."""
        pose = self._last.T_base_label.copy()
        pose[:3, 3] += self.place_at(t_s) - self._last.place_mm
        return pose

    @property
    def still(self) -> bool:
        """It has stood for the time that the settings ask for."""
        recent = self._recent
        if len(recent) < _LEAST_STILL:
            return False
        if recent[-1].at_s - recent[0].at_s < self._settings.still_s:
            return False
        places = np.array([sighting.place_mm for sighting in recent])
        noise = np.sqrt(np.max([np.diag(_noise(sighting)) for sighting in recent], axis=0))
        allowed = self._settings.still_mm + 3.0 * noise
        return bool(np.all(np.ptp(places, axis=0) <= allowed))

    @property
    def estimate(self) -> CarEstimate:
        """Where it is now."""
        still = self.still
        skew, sigma, turned = self._skew(still=still)
        last = self._last
        return CarEstimate(
            at_s=last.at_s,
            vehicle_id=last.vehicle_id,
            place_mm=self._state[:3].copy(),
            covariance_mm2=self._covariance[:3, :3] + _common(last.from_camera_mm),
            velocity_mm_s=np.zeros(3) if still else self._state[3:].copy(),
            braking_mm_s2=self._braking_mm_s2,
            still=still,
            skew_rad=skew,
            skew_sigma_rad=sigma,
            turned_rad=turned,
            distance_mm=float(np.linalg.norm(last.from_camera_mm)),
            flawed=last.flawed,
            faces_robot=self.faces_robot,
        )

    @property
    def _braking_mm_s2(self) -> float:
        """Mean deceleration over the last moments."""
        if len(self._speeds) < _LEAST_SPEEDS:
            return 0.0
        (since_s, before), (now_s, now) = self._speeds[0], self._speeds[-1]
        return (before - now) / (now_s - since_s)

    def _predicted(self, elapsed_s: float) -> tuple[Array, Array]:
        step = np.eye(6)
        step[:3, 3:] = elapsed_s * np.eye(3)
        push = np.concatenate((0.5 * elapsed_s**2 * np.eye(3), elapsed_s * np.eye(3)))
        noise = push @ np.diag(CAR_MM_S2**2) @ push.T
        return step @ self._state, step @ self._covariance @ step.T + noise

    def _skew(self, *, still: bool) -> tuple[float, float, float]:
        """Tilt of the socket, its standard deviation, and its part about the vertical [rad].

        Standing, all recent pictures count, each by its certainty; moving, only the last.
        """
        sightings = list(self._recent) if still else [self._last]
        information, weighted = np.zeros((2, 2)), np.zeros(2)
        for sighting in sightings:
            inverse = np.linalg.inv(sighting.lean_covariance)
            information += inverse
            weighted += inverse @ sighting.lean
        covariance = np.linalg.inv(information)
        lean = covariance @ weighted
        floor = LEAN_SIGMA
        if not still:
            shear = SHEAR_S * float(np.linalg.norm(self._state[3:])) / _LABEL_MM
            floor = math.hypot(LEAN_SIGMA, MOVING_LEAN_SIGMA, shear)
        covariance += floor**2 * np.eye(2)
        size = float(np.linalg.norm(lean))
        toward = lean / size if size > 1e-9 else np.array([1.0, 0.0])
        sigma = math.sqrt(float(toward @ covariance @ toward))
        return math.asin(min(1.0, size)), sigma, math.asin(max(-1.0, min(1.0, -float(lean[0]))))


def _noise(sighting: Sighting) -> Array:
    return np.asarray(sighting.covariance_mm2 + PICTURE_SIGMA_MM**2 * np.eye(3))


def _common(from_camera_mm: Array) -> Array:
    """Covariance of what all pictures have in common: along and across the line of sight."""
    distance_mm = float(np.linalg.norm(from_camera_mm))
    sight = from_camera_mm / distance_mm
    along = np.outer(sight, sight)
    aside_mm2 = (ASIDE_SIGMA * distance_mm) ** 2 + ROBOT_SIGMA_MM**2
    return np.asarray((SCALE_SIGMA * distance_mm) ** 2 * along + aside_mm2 * (np.eye(3) - along))
