"""The moving parts of the robot and the plug in its socket, advanced through time.

``Plant.advance`` is a function of its arguments: the past can be replayed and the near future
looked at without disturbing what really happens.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import NamedTuple

from drivers.simulator.actuators import StepperAxis, lagged, with_play
from drivers.simulator.parameters import SimulationParameters
from drivers.simulator.sag import RobotSag
from drivers.simulator.set_points import STILL, UNACCELERATED, SetPoint, SetPointLine
from drivers.simulator.socket_contact import FREE, Contact, Place, SocketContact
from drivers.simulator.view import Pose
from twin.as_built import PlanarAsBuilt
from twin.geometry import RobotGeometry
from twin.joints import JointPosition, JointVelocity, TipPosition
from twin.kinematics import LegsCannotCloseError, PlatformPosition, gamma

ARRIVED_MM = 1e-5
"""A slide this near a resting set point no longer moves."""


class PlantState(NamedTuple):
    """The plant at one instant.

    Attributes:
        t_s: When.
        motors: Positions of the motors in the board's coordinates.
        velocity: Velocities of the motors.
        carriages: True positions of carriages and slide, behind the play.
        contact: Plug and socket.
        blocked_since_s: Since when the rho3 motor has pushed at its force limit without moving.
        steady: Nothing moves, and nothing will until somebody does something.
        max_force_n: Largest contact force so far, in either direction.
        lateral_violation_mm: Largest sideways motion of the platform with the plug inserted.
    """

    t_s: float
    motors: JointPosition
    carriages: JointPosition
    velocity: JointVelocity = STILL
    contact: Contact = FREE
    blocked_since_s: float | None = None
    steady: bool = False
    max_force_n: float = 0.0
    lateral_violation_mm: float = 0.0

    @property
    def blocked_for_s(self) -> float:
        """How long the rho3 motor has pushed at its force limit without moving."""
        return 0.0 if self.blocked_since_s is None else self.t_s - self.blocked_since_s


class Socket:
    """The socket of the parked car in the base frame.

    Args:
        T_base_socket: Its pose.
        contact: Its forces.
    """

    def __init__(self, T_base_socket: Pose, contact: SocketContact) -> None:
        self.contact = contact
        self._face: tuple[float, ...] = tuple(T_base_socket[:3, 3].tolist())
        self.axis: tuple[float, ...] = tuple(T_base_socket[:3, 2].tolist())

    def depth_and_lateral_mm(self, tip: TipPosition) -> tuple[float, float]:
        """Depth of a point behind the face, and its distance from the socket's axis."""
        x, y, z = (p - f for p, f in zip(tip, self._face, strict=True))
        depth = self.depth_along(x, y, z)
        return depth, math.sqrt(max(x * x + y * y + z * z - depth * depth, 0.0))

    def depth_along(self, x: float, y: float, z: float) -> float:
        """Component of a displacement along the socket's axis."""
        return x * self.axis[0] + y * self.axis[1] + z * self.axis[2]


class Surroundings(NamedTuple):
    """What acts on the plant and only changes when somebody does something.

    Attributes:
        socket: The socket of the car.
        zero: True positions of the motors when the board's coordinates read 0.
        force_limit_n: True force at which the rho3 motor gives up.
        slide_jammed: Something blocks the slide.
    """

    socket: Socket
    zero: JointPosition
    force_limit_n: float
    slide_jammed: bool


class Plant:
    """The robot as it was built.

    Args:
        geometry: Its true geometry.
        mechanism: Its rails, belts and legs.
        parameters: Drives and contact.
        sag: Its deflection under self-weight.
    """

    def __init__(
        self,
        geometry: RobotGeometry,
        mechanism: PlanarAsBuilt,
        parameters: SimulationParameters,
        sag: RobotSag,
    ) -> None:
        self.geometry = geometry
        self.mechanism = mechanism
        self._sag = sag
        self._drives = parameters.drives
        self._contact = parameters.contact
        self._moving_step_s = parameters.board.moving_period_s
        # with the carriages at rest the platform need not be worked out again and again
        self._sagged = lru_cache(maxsize=16)(self._work_out_platform)
        play = parameters.drives.backlash_mm
        self._rail = (
            StepperAxis(parameters.drives, play[0]),
            StepperAxis(parameters.drives, play[1]),
        )

    def platform(self, state: PlantState) -> PlatformPosition:
        """True position of V, sag included [mm]."""
        return self._sagged(state.carriages.rho1_mm, state.carriages.rho2_mm)

    def _work_out_platform(self, rho1_mm: float, rho2_mm: float) -> PlatformPosition:
        v = self.mechanism.forward(rho1_mm, rho2_mm)
        return v._replace(y_mm=v.y_mm - self._sag.of_platform_mm(rho1_mm, rho2_mm))

    def tip(self, state: PlantState) -> TipPosition:
        """True position of the plug tip, sag included, as if no socket held it [mm]."""
        v = self.platform(state)
        rho3_mm = state.carriages.rho3_mm
        dy_mm, z_mm = gamma.tip_offset(self.geometry, rho3_mm)
        return TipPosition(v.x_mm, v.y_mm + dy_mm - self._sag.of_tip_mm(rho3_mm), z_mm)

    def contact_force_n(self, state: PlantState, around: Surroundings, rho3_mm: float) -> float:
        """Contact force if the rho3 motor stood elsewhere and all else as it does."""
        return self._push_slide(state, around, rho3_mm).contact.force_n

    def advance(
        self, state: PlantState, line: SetPointLine, around: Surroundings, until_s: float
    ) -> PlantState:
        """The state at a later time.

        Args:
            state: At the beginning.
            line: The set points.
            around: What acts on the plant; constant over the whole stretch.
            until_s: When.
        """
        for piece_end_s, piece in line.pieces_between(state.t_s, until_s):
            if piece is not None:
                state = state._replace(steady=False)
            while state.t_s < piece_end_s:
                if state.steady:
                    state = state._replace(t_s=piece_end_s)
                    break
                in_contact = state.contact.depth_mm > -self._contact.near_mm
                step_s = self._contact.step_s if in_contact else self._moving_step_s
                # the last step takes what is left, rather than leave a sliver of rounding
                left_s = piece_end_s - state.t_s
                end_s = piece_end_s if left_s < 1.5 * step_s else state.t_s + step_s
                if piece is None:
                    resting = line.at(state.t_s).position
                    wanted = SetPoint(resting, STILL, UNACCELERATED)
                else:
                    wanted = piece.at(state.t_s)
                state = self._step(state, wanted, around, end_s, holding=piece is None)
        return state

    def _step(
        self,
        state: PlantState,
        wanted: SetPoint,
        around: Surroundings,
        end_s: float,
        *,
        holding: bool,
    ) -> PlantState:
        """One step within one piece of the set point, or at rest."""
        elapsed_s = end_s - state.t_s
        motors, carriages = self._move_rail(state, wanted, around, elapsed_s)
        slide_mm = lagged(
            state.motors.rho3_mm,
            wanted.position.rho3_mm,
            velocity_mm_s=wanted.velocity.rho3_mm_s,
            acceleration_mm_s2=wanted.acceleration.rho3_mm_s2,
            elapsed_s=elapsed_s,
            lag_s=self._drives.lag_s,
        )
        moved = state._replace(t_s=end_s, motors=motors, carriages=carriages)
        free = self._push_slide(moved, around, slide_mm)
        moved, share = self._within_force(state, moved, free, around, slide_mm)
        travel_mm = moved.motors.rho3_mm - state.motors.rho3_mm
        blocked = share < 1.0
        since_s = state.t_s if state.blocked_since_s is None else state.blocked_since_s
        arrived = abs(moved.motors.rho3_mm - wanted.position.rho3_mm) < ARRIVED_MM
        steady = holding and (arrived or (blocked and travel_mm == 0.0))
        rail = [
            v + a * elapsed_s for v, a in zip(wanted.velocity, wanted.acceleration, strict=True)
        ]
        return moved._replace(
            velocity=STILL if steady else JointVelocity(rail[0], rail[1], travel_mm / elapsed_s),
            blocked_since_s=since_s if blocked else None,
            steady=steady,
            max_force_n=max(state.max_force_n, abs(moved.contact.force_n)),
            lateral_violation_mm=max(
                state.lateral_violation_mm, self._sideways_mm(moved, around.socket)
            ),
        )

    def _move_rail(
        self, state: PlantState, wanted: SetPoint, around: Surroundings, elapsed_s: float
    ) -> tuple[JointPosition, JointPosition]:
        """Motors and carriages of rho1 and rho2 after a step; rho3 as before."""
        motors, carriages = list(state.motors), list(state.carriages)
        for i, axis in enumerate(self._rail):
            q, v, a = wanted.position[i], wanted.velocity[i], wanted.acceleration[i]
            counter_mm = axis.counter(q + elapsed_s * (v + 0.5 * a * elapsed_s))
            if v == a == 0.0 and counter_mm == motors[i]:
                continue
            motors[i] = counter_mm
            carriages[i] = axis.carriage(
                carriages[i],
                around.zero[i],
                start_mm=q,
                velocity_mm_s=v,
                acceleration_mm_s2=a,
                elapsed_s=elapsed_s,
            )
        try:
            self._sagged(carriages[0], carriages[1])
        except LegsCannotCloseError:
            # stretched legs hold the carriages back; the belts give way until the motors return
            carriages[:2] = state.carriages[:2]
        return JointPosition(*motors), JointPosition(*carriages)

    def _push_slide(self, state: PlantState, around: Surroundings, motor_mm: float) -> PlantState:
        """The plant with the rho3 motor at another place, whatever force that takes."""
        carriage_mm = with_play(
            state.carriages.rho3_mm, around.zero.rho3_mm + motor_mm, self._drives.backlash_mm[2]
        )
        state = state._replace(
            motors=state.motors._replace(rho3_mm=motor_mm),
            carriages=state.carriages._replace(rho3_mm=carriage_mm),
        )
        tip = self.tip(state)
        depth_mm, lateral_mm = around.socket.depth_and_lateral_mm(tip)
        if depth_mm < 0 and state.contact.place is Place.FREE:
            contact = state.contact._replace(depth_mm=depth_mm)
        else:
            contact = around.socket.contact.moved(
                state.contact, depth_mm, lateral_mm, self.platform(state)
            )
        return state._replace(contact=contact)

    def _within_force(
        self,
        before: PlantState,
        held: PlantState,
        free: PlantState,
        around: Surroundings,
        motor_mm: float,
    ) -> tuple[PlantState, float]:
        """As much of the slide's step as the motor's force allows, and which share that is."""
        start_mm = before.motors.rho3_mm
        travel_mm = motor_mm - start_mm
        if abs(travel_mm) < ARRIVED_MM * 0.01:
            return free, 1.0
        if around.slide_jammed:
            return self._push_slide(held, around, start_mm), 0.0
        direction = math.copysign(1.0, travel_mm)
        load_n = direction * free.contact.force_n + self._drives.friction_n
        if load_n <= around.force_limit_n:
            return free, 1.0
        load_before_n = direction * before.contact.force_n + self._drives.friction_n
        if load_before_n >= around.force_limit_n:
            share = 0.0
        else:
            share = (around.force_limit_n - load_before_n) / (load_n - load_before_n)
        return self._push_slide(held, around, start_mm + share * travel_mm), share

    def _sideways_mm(self, state: PlantState, socket: Socket) -> float:
        """How far the platform has moved across the socket's axis since the plug went in."""
        entry = state.contact.entry_platform
        if state.contact.place is not Place.IN_SOCKET or entry is None:
            return 0.0
        now = self.platform(state)
        if now == entry:
            return 0.0
        dx, dy = now.x_mm - entry.x_mm, now.y_mm - entry.y_mm
        along = socket.depth_along(dx, dy, 0.0)
        return math.sqrt(max(dx * dx + dy * dy - along * along, 0.0))
