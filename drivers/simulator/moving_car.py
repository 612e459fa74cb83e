"""The motion of a car on its way to its place: driver, steering, speed and springs.

The car is a bicycle model: with the heading psi (0 is straight to the wall, positive to the
driver's left) and the curvature k of the rear axle's way,

    x' = -v sin(psi),   z' = -v cos(psi),   psi' = k v.

The driver aims at a point of the line that the rear axle should follow (pure pursuit: R. C.
Coulter, CMU-RI-TR-92-01, 1992), never quite exactly, and turns the wheel no faster than a person
does. Speed is limited in jerk. The body pitches on its springs as a damped oscillator that braking
excites, so the nose nods when the car comes to a stop.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from typing import NamedTuple

import numpy as np

from drivers.simulator import poses
from drivers.simulator.driving import DrivingParameters
from drivers.simulator.view import Pose
from twin.motion.trajectory import AxisLimits, Trajectory, solve_position, solve_stop

STEP_S = 0.004
KEPT_S = 5.0
_STILL_RAD = 1e-6
_STILL_RAD_S = 1e-5


class CarState(NamedTuple):
    """The car at one instant.

    Attributes:
        t_s: When.
        x_mm: Rear axle along the rail.
        z_mm: Rear axle from the wall.
        heading_rad: 0 is straight to the wall, positive turned to the driver's left.
        curvature_mm: Of the way, 1 / mm.
        way_mm: Driven since the beginning, backwards counts negative.
        speed_mm_s: Forward.
        acceleration_mm_s2: Forward.
        pitch_rad: Nose down.
        pitch_rad_s: Its rate.
    """

    t_s: float
    x_mm: float
    z_mm: float
    heading_rad: float
    curvature_mm: float = 0.0
    way_mm: float = 0.0
    speed_mm_s: float = 0.0
    acceleration_mm_s2: float = 0.0
    pitch_rad: float = 0.0
    pitch_rad_s: float = 0.0


class MovingCar:
    """A car under way; what it did and what it is about to do, at any time.

    Args:
        numbers: Of car and driver.
        place_mm: Where its socket is in the base frame when it stands as its pose says, shape (3,).
        start: Where it begins.
        line_x_mm: The line that the driver wants the rear axle on.
        phase: Of the driver's wandering [rad].
    """

    def __init__(
        self,
        numbers: DrivingParameters,
        place_mm: poses.Vector,
        start: CarState,
        line_x_mm: float,
        phase: float,
    ) -> None:
        self._numbers = numbers
        self._axle_mm = place_mm + np.array([0.0, 0.0, numbers.nose_mm])
        self._line_x_mm = line_x_mm
        self._phase = phase
        self._samples = [start]
        self._plan: Trajectory | None = None
        self._plan_from_s = start.t_s
        self._steers = False
        self._goal_mm = 0.0
        self._creeps = False

    def go(self, now_s: float, distance_mm: float, *, steer: bool) -> None:
        """Drive so far, backwards if negative, and stop.

        Args:
            now_s: From when.
            distance_mm: Along the way of the rear axle.
            steer: Aim at the line; otherwise the wheels go straight.
        """
        state = self._cut(now_s)
        self._steers, self._goal_mm, self._creeps = steer, state.way_mm + distance_mm, False
        self._plan_way(state, self._numbers.cruise_mm_s)

    def brake(self, now_s: float) -> None:
        """Stop as soon as brakes allow without skidding."""
        state = self._cut(now_s)
        if state.speed_mm_s == 0:
            return
        numbers = self._numbers
        limits = AxisLimits(
            max(abs(state.speed_mm_s), 1.0), numbers.brake_mm_s2, numbers.brake_jerk_mm_s3
        )
        self._follow(
            solve_stop([limits], [state.way_mm], [state.speed_mm_s], [state.acceleration_mm_s2]),
            state,
        )
        self._creeps = True

    def aim_beside(self, right_mm: float) -> None:
        """From now on the driver aims so far to the right of the line aimed at until now."""
        self._line_x_mm += right_mm

    def displacement_at(self, t_s: float) -> Pose:
        """Maps where everything on the car is at its place to where it is then, shape (4, 4)."""
        state = self.state_at(t_s)
        numbers = self._numbers
        centre = np.array([0.0, -numbers.pitch_centre_below_mm, -0.5 * numbers.wheelbase_mm])
        nod = poses.rotation_x(-state.pitch_rad)
        body = poses.pose(nod, centre - nod @ centre)
        axle = np.array([state.x_mm, self._axle_mm[1], state.z_mm])
        driven = poses.pose(poses.rotation_y(state.heading_rad), axle)
        return np.asarray(driven @ body @ poses.pose(np.eye(3), -self._axle_mm))

    def state_at(self, t_s: float) -> CarState:
        """The car at a time; before the beginning it stands at its beginning."""
        while self._samples[-1].t_s < t_s and not self.rests(self._samples[-1]):
            self._samples.append(self._step(self._samples[-1]))
        index = bisect_right(self._samples, t_s, key=lambda sample: sample.t_s)
        if index == 0:
            return self._samples[0]
        if index == len(self._samples):
            return self._samples[-1]
        before, after = self._samples[index - 1], self._samples[index]
        share = (t_s - before.t_s) / (after.t_s - before.t_s)
        return CarState(*(a + share * (b - a) for a, b in zip(before, after, strict=True)))

    def rests(self, state: CarState) -> bool:
        """Nothing moves any more, and nothing will."""
        over = self._plan is None or state.t_s >= self._plan_from_s + self._plan.duration
        nods = abs(state.pitch_rad) > _STILL_RAD or abs(state.pitch_rad_s) > _STILL_RAD_S
        return over and state.speed_mm_s == 0 and not nods

    def _cut(self, now_s: float) -> CarState:
        """Forget what was worked out beyond a time, and the distant past; the state then."""
        self.state_at(now_s)
        if self._samples[-1].t_s < now_s:  # it has rested since
            self._samples.append(self._samples[-1]._replace(t_s=now_s))
        self._samples = [s for s in self._samples if now_s - KEPT_S <= s.t_s <= now_s] or [
            self._samples[0]
        ]
        return self._samples[-1]

    def _plan_way(self, state: CarState, speed_mm_s: float) -> None:
        numbers = self._numbers
        limits = AxisLimits(speed_mm_s, numbers.acceleration_mm_s2, numbers.jerk_mm_s3)
        self._follow(
            solve_position(
                [limits],
                [state.way_mm],
                [state.speed_mm_s],
                [state.acceleration_mm_s2],
                [self._goal_mm],
            ),
            state,
        )

    def _follow(self, plan: Trajectory, state: CarState) -> None:
        self._plan, self._plan_from_s = plan, state.t_s

    def _step(self, state: CarState) -> CarState:
        numbers, end_s = self._numbers, state.t_s + STEP_S
        if not self._creeps and abs(self._goal_mm - state.way_mm) < numbers.creep_from_mm:
            self._creeps = True
            self._plan_way(state, numbers.creep_mm_s)
        way, speed, acceleration = self._planned(state, end_s)
        curvature = self._steered(state)
        step_mm = way - state.way_mm
        # the middle of the step: exact to second order
        heading = state.heading_rad + 0.5 * curvature * step_mm
        rate = state.pitch_rad_s + STEP_S * self._pitch_acceleration(state, acceleration)
        return CarState(
            t_s=end_s,
            x_mm=state.x_mm - step_mm * math.sin(heading),
            z_mm=state.z_mm - step_mm * math.cos(heading),
            heading_rad=state.heading_rad + curvature * step_mm,
            curvature_mm=curvature,
            way_mm=way,
            speed_mm_s=speed,
            acceleration_mm_s2=acceleration,
            pitch_rad=state.pitch_rad + STEP_S * rate,
            pitch_rad_s=rate,
        )

    def _planned(self, state: CarState, t_s: float) -> tuple[float, float, float]:
        """Way, speed and acceleration of the plan; at rest after its end."""
        if self._plan is None:
            return state.way_mm, 0.0, 0.0
        since_s = t_s - self._plan_from_s
        way, speed, acceleration = self._plan.at_time(min(since_s, self._plan.duration))
        if since_s >= self._plan.duration:
            return way[0], 0.0, 0.0
        return way[0], speed[0], acceleration[0]

    def _steered(self, state: CarState) -> float:
        """Curvature after a step: what the driver aims at, as far as the wheel turns by then."""
        numbers = self._numbers
        wanted, lock = 0.0, 1.0 / numbers.least_radius_mm
        if self._steers:
            ahead = numbers.look_ahead_mm
            aside = max(-ahead, min(ahead, self._line_x_mm - state.x_mm))
            aim_rad = math.asin(-aside / ahead) + self._wander_rad(state.way_mm)
            wanted = 2.0 * math.sin(aim_rad - state.heading_rad) / ahead
        wanted = max(-lock, min(lock, wanted))
        most = lock / numbers.steering_s * STEP_S
        return state.curvature_mm + max(-most, min(most, wanted - state.curvature_mm))

    def _wander_rad(self, way_mm: float) -> float:
        """Two waves that never repeat together: smooth, and the same for the same way."""
        turn = 2 * math.pi * way_mm / self._numbers.wander_mm
        waves = math.sin(turn + self._phase) + math.sin(math.sqrt(2) * turn + 2 * self._phase)
        return 0.5 * self._numbers.wander_rad * waves

    def _pitch_acceleration(self, state: CarState, acceleration_mm_s2: float) -> float:
        omega = 2 * math.pi * self._numbers.pitch_hz
        rest_rad = -self._numbers.pitch_rad_per_mm_s2 * acceleration_mm_s2
        spring = omega**2 * (rest_rad - state.pitch_rad)
        return spring - 2 * self._numbers.pitch_damping * omega * state.pitch_rad_s
