"""The simulated world: one robot as it was built, one parked car, and what passes between them.

The world has no clock and no task of its own. Whoever asks says what time it is, and everything
up to then is worked out; between two questions at rest nothing is computed.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from drivers.simulator.build import built_geometry, built_mount, built_plant
from drivers.simulator.car import ParkedCar, park
from drivers.simulator.car_spot import CarSpot
from drivers.simulator.moving_car import MovingCar
from drivers.simulator.parameters import SimulationParameters
from drivers.simulator.plant import PlantState, Socket, Surroundings
from drivers.simulator.randomness import Streams
from drivers.simulator.set_points import SetPointLine
from drivers.simulator.socket_contact import FREE, Place, SocketContact
from drivers.simulator.truth import GroundTruth, ground_truth
from drivers.simulator.view import CameraView
from drivers.simulator.watching import camera_view
from twin.camera_mount import CameraMount
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import alpha
from twin.motion.limits import MotionLimits
from twin.motion.segments import Segment
from twin.statics import DEFAULT_TABLES, SagTables

HISTORY_S = 2.0
"""How far back the camera may look."""

TIGHT_SHARE = 0.75
"""Of the force limit: at a stall with less, the board does not trust its encoder."""

ConnectionListener = Callable[[bool, float], None]
"""Called with whether the pilot contact is made, and when it changed [s]."""


class CarIsPluggedInError(RuntimeError):
    """The car cannot be moved while the plug is in its socket."""


class SimulatedWorld:
    """Robot (``plant``), car and physics behind the simulated drivers.

    Args:
        geometry: The robot as drawn, which is what the drivers' users know.
        limits: How fast its joints may move.
        mount: The camera on the platform, as drawn.
        parameters: All numbers.
        seed: Decides every random quantity.
        sag: How far it sags under its own weight.
    """

    def __init__(
        self,
        geometry: RobotGeometry,
        limits: MotionLimits,
        mount: CameraMount,
        parameters: SimulationParameters,
        seed: int,
        *,
        sag: SagTables = DEFAULT_TABLES,
    ) -> None:
        self.geometry = geometry
        self.limits = limits
        self.parameters = parameters
        self.streams = Streams.from_seed(seed)
        true_geometry = built_geometry(geometry, parameters.build, self.streams.build)
        self._platform_camera = built_mount(mount, parameters.build, self.streams.build)
        force_error = self.streams.build.normal(0.0, parameters.drives.force_scale_std)
        self._force_scale = 1.0 + float(force_error)
        self.plant = built_plant(true_geometry, parameters, sag, self.streams.build)
        self._force_limit_n = parameters.board.default_force_limit_n
        self._slide_jammed = False
        self._listeners: list[ConnectionListener] = []
        self._pilot_made = False
        self.load_breaks = 0

        stored = self._power_up_joints()
        creep = self.streams.power_up.normal(0.0, parameters.homing.power_off_creep_std_mm, 3)
        if parameters.board.start_homed:
            creep[:] = 0.0
        self._zero = JointPosition(*creep.tolist())
        self.line = SetPointLine(
            stored,
            0.0,
            deceleration_mm_s2=parameters.board.stop_deceleration_mm_s2,
            still_mm_s=parameters.board.velocity_tolerance_mm_s,
        )
        standing = JointPosition(*(q + z for q, z in zip(stored, self._zero, strict=True)))
        self._state = PlantState(0.0, stored, standing)
        self._history = deque([self._state])
        car = park(geometry, parameters.car, parameters.contact, self.streams.car)
        self.spot = CarSpot(car)
        self._take_in(car)

    def _power_up_joints(self) -> JointPosition:
        """Where the board remembers to stand when it wakes up.

        Raises:
            LegsCannotCloseError: the robot cannot stand there.
        """
        joints = self.parameters.board.start_joints or self.homed_joints
        alpha.forward(self.geometry, joints.rho1_mm, joints.rho2_mm)
        return joints

    @property
    def homed_joints(self) -> JointPosition:
        """Where homing ends: the platform over the middle of the rail, the slide drawn back."""
        half_mm = 0.5 * self.parameters.homing.carriage_sum_mm
        return JointPosition(half_mm, half_mm, self.geometry.rho3.min_mm)

    # --- the car -----------------------------------------------------------------------------

    @property
    def car(self) -> ParkedCar:
        """The car in the garage, or the one that has just left it."""
        return self.spot.at(self.now_s)

    def park_car(self, seed: int) -> None:
        """Another car parks at a place of its own.

        Raises:
            CarIsPluggedInError: the plug is in the socket.
        """
        rng = np.random.default_rng(seed)
        parked = park(self.geometry, self.parameters.car, self.parameters.contact, rng)
        self.put_car(replace(parked, payload=self.car.payload))

    def remove_car(self) -> None:
        """The car drives away.

        Raises:
            CarIsPluggedInError: the plug is in the socket.
        """
        self._require_unplugged()
        self.spot.vanish()
        self._take_in(self.car)

    def let_drive(self, moving: MovingCar, now_s: float) -> None:
        """From now on the car is where its driver brings it.

        Raises:
            CarIsPluggedInError: the plug is in the socket.
        """
        self.advance(now_s)
        self._require_unplugged()
        self.spot.drive(moving)
        self._take_in(self.car)

    def stick_label(self, text: str) -> None:
        """Put a new label over the old one, with another text; cars that park later have it too."""
        self.spot.stick_label(text)

    def hide_label(self) -> None:
        """Something covers the label; the socket stays where it is."""
        self.spot.cover_label(covered=True)

    def show_label(self) -> None:
        """The label can be seen again."""
        self.spot.cover_label(covered=False)

    def put_car(self, car: ParkedCar) -> None:
        """A car stands here now, as ``park_car`` puts one."""
        self._require_unplugged()
        self.spot.park(car)
        self._take_in(car)

    def _require_unplugged(self) -> None:
        if self._state.contact.place is Place.IN_SOCKET:
            raise CarIsPluggedInError("the plug is in the socket: withdraw it first")

    def _take_in(self, car: ParkedCar) -> None:
        self.wanted_wh = car.wanted_wh
        self._socket = Socket(
            car.T_base_socket, SocketContact(self.parameters.contact, car.peak_force_n)
        )
        self._disturb(self._state._replace(contact=FREE, max_force_n=0.0, lateral_violation_mm=0.0))

    # --- time --------------------------------------------------------------------------------

    @property
    def now_s(self) -> float:
        """Up to when everything is worked out."""
        return self._state.t_s

    def advance(self, now_s: float) -> PlantState:
        """Work out everything up to a time and return the state then."""
        if now_s <= self._state.t_s:
            return self._state
        if self.spot.moving is not None:
            self._socket = Socket(self.spot.at(now_s).T_base_socket, self._socket.contact)
        self._state = self.plant.advance(self._state, self.line, self.surroundings, now_s)
        self._history.append(self._state)
        while self._history[0].t_s < now_s - HISTORY_S:
            self._history.popleft()
        self.line.forget(self._history[0].t_s)
        self._report_connection()
        return self._state

    @property
    def surroundings(self) -> Surroundings:
        """What acts on the plant now."""
        return Surroundings(
            self._socket, self._zero, self._force_limit_n / self._force_scale, self._slide_jammed
        )

    def _disturb(self, state: PlantState) -> None:
        """Something happened from outside: this is the state now, and it may not be steady."""
        self._state = state._replace(steady=False)
        self._history.append(self._state)

    def _state_at(self, t_s: float) -> PlantState:
        """The state at a time of the recent past or the near future."""
        start = self._state
        if t_s < start.t_s:
            before = (state for state in reversed(self._history) if state.t_s <= t_s)
            start = next(before, self._history[0])
        return self.plant.advance(start, self.line, self.surroundings, t_s)

    # --- the board's side --------------------------------------------------------------------

    def set_force_limit(self, force_n: float, now_s: float) -> None:
        """Let the rho3 motor push and pull no harder, as far as its current tells [N]."""
        state = self.advance(now_s)
        self._force_limit_n = force_n
        self._disturb(state)

    def measured_force_n(self, state: PlantState) -> float:
        """Force of the rho3 motor as its current shows it, without noise."""
        wanted_mm = self.line.at(state.t_s).position.rho3_mm - state.motors.rho3_mm
        if state.blocked_since_s is not None and wanted_mm != 0:
            return math.copysign(self._force_limit_n, wanted_mm)
        friction_n = self.parameters.drives.friction_n * float(np.sign(state.velocity.rho3_mm_s))
        return (state.contact.force_n + friction_n) * self._force_scale

    def pushes_tight(self, state: PlantState) -> bool:
        """The slide was seen to slow down: it rests against a force near its limit."""
        load_n = abs(state.contact.force_n) + self.parameters.drives.friction_n
        return load_n * self._force_scale >= TIGHT_SHARE * self._force_limit_n

    def follow(self, segments: Sequence[Segment], now_s: float) -> None:
        """Put segments behind those that the set point already follows."""
        state = self.advance(now_s)
        self.line.append(now_s, segments)
        self._disturb(state)

    def brake(self, now_s: float, *, rho3_mm: float | None = None) -> None:
        """Let the set point come to rest from now on; see ``SetPointLine.brake``."""
        state = self.advance(now_s)
        self.line.brake(now_s, rho3_mm=rho3_mm)
        self._disturb(state)

    def drive_to(self, position: JointPosition, now_s: float) -> None:
        """Make the set point jump; the joints rest there from now on."""
        state = self.advance(now_s)
        self.line.jump(now_s, position)
        self._disturb(state)

    def renumber(self, joint: int, counter_mm: float, now_s: float) -> None:
        """Give a joint at rest another coordinate; nothing moves.

        Args:
            joint: 0, 1, 2 for rho1, rho2, rho3.
            counter_mm: What the board's counter shall read where the joint stands now.
            now_s: When.
        """
        state = self.advance(now_s)
        zero, motors = list(self._zero), list(state.motors)
        zero[joint] += motors[joint] - counter_mm
        motors[joint] = counter_mm
        self._zero = JointPosition(*zero)
        self.line.jump(now_s, JointPosition(*motors))
        self._disturb(state._replace(motors=JointPosition(*motors)))

    def contact_forces_n(self, rho3_mm: Sequence[float]) -> list[float]:
        """What the socket would do against the plug if the rho3 motor stood elsewhere now.

        Args:
            rho3_mm: Positions of that motor in the board's coordinates.
        """
        around = self.surroundings
        return [self.plant.contact_force_n(self._state, around, motor) for motor in rho3_mm]

    # --- the station's side ------------------------------------------------------------------

    @property
    def pilot_made(self) -> bool:
        """The pilot contact between car and station is closed."""
        return self._pilot_made

    def on_connection(self, listener: ConnectionListener) -> None:
        """Call a listener whenever the pilot contact opens or closes."""
        self._listeners.append(listener)

    def lock_connector(self, *, locked: bool, now_s: float) -> None:
        """Close or open the lock of the connector."""
        state = self.advance(now_s)
        locked_at_mm = state.contact.depth_mm if locked else None
        self._disturb(state._replace(contact=state.contact._replace(locked_at_mm=locked_at_mm)))

    def _report_connection(self) -> None:
        contact = self._state.contact
        depth_mm = contact.depth_mm if contact.place is Place.IN_SOCKET else 0.0
        numbers = self.parameters.contact
        threshold_mm = numbers.pilot_breaks_mm if self._pilot_made else numbers.pilot_makes_mm
        made = depth_mm >= threshold_mm
        if made != self._pilot_made:
            self._pilot_made = made
            for listener in self._listeners:
                listener(made, self._state.t_s)

    # --- faults ------------------------------------------------------------------------------

    def jam_slide(self, now_s: float) -> None:
        """Block the slide where it stands."""
        state = self.advance(now_s)
        self._slide_jammed = True
        self._disturb(state)

    def free_slide(self, now_s: float) -> None:
        """Take away what blocks the slide."""
        state = self.advance(now_s)
        self._slide_jammed = False
        self._disturb(state)

    # --- what is seen and what is true -------------------------------------------------------

    def view_at(self, t_s: float) -> CameraView:
        """The scene in the camera frame at a time of the recent past or the near future [s]."""
        state, car = self._state_at(t_s), self.spot.at(t_s)
        velocity_mm_s = self.spot.label_velocity_mm_s(t_s)
        return camera_view(self.plant, state, self._platform_camera, car, velocity_mm_s)

    def truth(self, at_s: float | None = None) -> GroundTruth:
        """The truth at a time, or when something was last worked out."""
        state = self._state if at_s is None else self.advance(at_s)
        contact = self.parameters.contact
        return ground_truth(self.plant, state, self.car, contact, load_breaks=self.load_breaks)
