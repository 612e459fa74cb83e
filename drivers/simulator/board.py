"""The simulated motion board: its states, its refusals and its faults.

Like the world it has no task of its own: ``sync`` brings it up to date, and every command does so
first. Faults are found at the next ``sync``, which the driver calls at the rate of the telemetry.
"""

from __future__ import annotations

from collections.abc import Sequence

from drivers.robot import (
    SEGMENT_NUMBERS,
    BoardFault,
    BoardRefusedError,
    BoardState,
    CommandedJoints,
    FaultCode,
    LimitSwitches,
    MeasuredJoints,
    QueueFullError,
    RobotState,
    StopCategory,
)
from drivers.simulator.actuators import encoder_reading
from drivers.simulator.plant import PlantState
from drivers.simulator.segment_check import JOINTS, check_segments
from drivers.simulator.world import SimulatedWorld
from twin.motion.segments import Segment

MOVING = {BoardState.RUN, BoardState.STOPPING, BoardState.HOMING}


class SimulatedBoard:
    """The firmware and its drives.

    Args:
        world: What it drives.
    """

    def __init__(self, world: SimulatedWorld) -> None:
        self.world = world
        self._numbers = world.parameters.board
        self._release_when_stopped = False
        self._moving = False
        self._cut_switches = [False, False, False]
        self._stop_button = False
        self.state = BoardState.BOOT
        self.fault: BoardFault | None = None
        self.enabled = False
        self.homed = self._numbers.start_homed

    # --- commands ----------------------------------------------------------------------------

    def finish_boot(self, now_s: float) -> None:
        """The firmware has started; the drives are off."""
        self.sync(now_s)
        if self.state is BoardState.BOOT:
            self.state = BoardState.IDLE

    def enable(self, now_s: float) -> None:
        """Energise the drives.

        Raises:
            BoardRefusedError: the board has not started, or a fault is latched.
        """
        self.sync(now_s)
        if self.state in {BoardState.BOOT, BoardState.FAULT}:
            reason, words = self._why_not_ready()
            raise BoardRefusedError(f"The drives stay off: {words}.", reason)
        self.enabled = True
        if self.state is BoardState.IDLE:
            self.state = BoardState.READY

    def disable(self, now_s: float) -> None:
        """De-energise the drives; the brake keeps the positions.

        Raises:
            BoardRefusedError: the robot moves.
        """
        self.sync(now_s)
        if self.moving:
            words = "The drives stay on while the robot moves; stop it first."
            raise BoardRefusedError(words, "moving")
        self.enabled = False
        if self.state is BoardState.READY:
            self.state = BoardState.IDLE

    def push(self, segments: Sequence[Segment], now_s: float) -> None:
        """Append segments to the queue; all or none.

        Raises:
            QueueFullError: they do not fit.
            BoardRefusedError: the board cannot follow them, or not now.
        """
        self.sync(now_s)
        if not segments:
            return
        if self.state not in {BoardState.READY, BoardState.RUN}:
            reason, words = self._why_not_ready()
            raise BoardRefusedError(f"No motion is possible: {words}.", reason)
        if not self.homed:
            words = "No motion is possible before homing: positions are unknown."
            raise BoardRefusedError(words, "not_homed")
        free = self.queue_free(now_s)
        if len(segments) > free:
            raise QueueFullError(f"{len(segments)} segments were pushed into {free} free places.")
        _, position, velocity = self.world.line.queue_end(now_s)
        check_segments(segments, position, velocity, self.world)
        self.world.follow(segments, now_s)
        self.state = BoardState.RUN
        self._moving = True

    def set_force_limit(self, force_n: float, now_s: float) -> None:
        """Cap the force of the rho3 motor.

        Raises:
            BoardRefusedError: the motor cannot do that.
        """
        largest_n = self.world.parameters.drives.max_force_n
        if not 0 < force_n <= largest_n:
            raise BoardRefusedError(
                f"A force limit of {force_n:g} N is not possible; it must be above 0 and at most "
                f"{largest_n:g} N.",
                "bad_value",
            )
        self.sync(now_s)
        self.world.set_force_limit(force_n, now_s)

    def stop(self, category: StopCategory, now_s: float) -> None:
        """Drop the queue and decelerate."""
        self.sync(now_s)
        if category is StopCategory.DECELERATE_AND_RELEASE:
            self._release_when_stopped = True
        if self.state in {BoardState.RUN, BoardState.HOMING}:
            self.world.brake(now_s)
            self.state = BoardState.STOPPING
        self.sync(now_s)

    def emergency_stop(self, now_s: float) -> None:
        """Decelerate, release the drives and latch the fault."""
        self.sync(now_s)
        self._release_when_stopped = True
        self.latch(FaultCode.EMERGENCY_STOP, "Emergency stop.", now_s)
        self.sync(now_s)

    def clear_fault(self, now_s: float) -> None:
        """Release the latched fault.

        A pressed limit switch does not hinder it: the way out is homing, which leaves the switch.

        Raises:
            BoardRefusedError: the robot still moves, or the emergency-stop button is still pressed.
        """
        self.sync(now_s)
        if self.fault is None:
            return
        if self.moving:
            words = "The fault stays latched until the robot stands still."
            raise BoardRefusedError(words, "moving")
        if self._stop_button:
            words = "The fault stays latched: the emergency-stop circuit is open."
            raise BoardRefusedError(words, "cause_present")
        self.fault = None
        self.state = BoardState.READY if self.enabled else BoardState.IDLE

    def begin_homing(self, now_s: float) -> None:
        """Enter HOMING; the positions are unknown from now on.

        Raises:
            BoardRefusedError: the board is not READY.
        """
        self.sync(now_s)
        if self.state is not BoardState.READY:
            reason, words = self._why_not_ready()
            raise BoardRefusedError(f"Homing is not possible: {words}.", reason)
        self.homed = False
        self.state = BoardState.HOMING

    def end_homing(self) -> None:
        """Leave HOMING with valid positions."""
        self.homed = True
        self.state = BoardState.READY

    def link_lost(self, now_s: float) -> None:
        """No heartbeat came for too long; that matters while the drives are on."""
        self.sync(now_s)
        if self.fault is None and (self.enabled or self.moving):
            self._release_when_stopped = True
            self.latch(FaultCode.HEARTBEAT_LOST, "The host has fallen silent.", now_s)

    def cut_switch(self, joint: int, *, cut: bool) -> None:
        """Open the wire of a limit switch, which reads as pressed, or mend it."""
        self._cut_switches[joint] = cut

    def press_stop_button(self, now_s: float, *, pressed: bool) -> None:
        """The emergency-stop button: cuts the power of the motors, so that steps may get lost."""
        self.sync(now_s)
        self._stop_button = pressed
        if pressed:
            self._release_when_stopped = True
            self.latch(FaultCode.EMERGENCY_STOP, "The emergency-stop circuit is open.", now_s)
            self.homed = False
        self.sync(now_s)

    # --- what goes on ------------------------------------------------------------------------

    @property
    def moving(self) -> bool:
        """At the last ``sync`` the set point moved, or a joint was still on its way to it."""
        return self._moving

    def queue_free(self, now_s: float) -> int:
        """Segments that can be pushed now."""
        if self.state not in {BoardState.READY, BoardState.RUN}:
            return 0 if self.state is BoardState.HOMING else self._numbers.queue_capacity
        return self._numbers.queue_capacity - self.world.line.waiting(now_s)

    def latch(self, code: FaultCode, detail: str, now_s: float) -> None:
        """Stop as the fault demands and latch it; the first of several stays."""
        state = self.world.advance(now_s)
        if code is FaultCode.LIMIT_SWITCH:
            # steps stop at once, so their count is no longer to be trusted
            here = self.world.line.at(now_s).position._replace(rho3_mm=state.motors.rho3_mm)
            self.world.drive_to(here, now_s)
            self.homed = False
        elif code in {FaultCode.STALL, FaultCode.FOLLOWING_ERROR}:
            self.world.brake(now_s, rho3_mm=state.motors.rho3_mm)
            if code is FaultCode.FOLLOWING_ERROR or not self.world.pushes_tight(state):
                self.homed = False  # as on the real board, whose encoder may be dead
        elif not self.world.line.ran_empty(now_s):
            self.world.brake(now_s)
        if self.fault is None:
            self.fault = BoardFault(code, detail)
        self.state = BoardState.FAULT

    def sync(self, now_s: float) -> PlantState:
        """Bring plant and board up to date."""
        state = self.world.advance(now_s)
        if self.state in MOVING and self._find_fault(state, now_s):
            state = self.world.advance(now_s)
        if self.state is BoardState.STOPPING and state.blocked_since_s is not None:
            state = self._give_way(state, now_s)
        # a slide that pushes in vain has not arrived: it will move on, or stall
        in_vain = state.blocked_since_s is not None
        self._moving = in_vain or not state.steady or now_s < self.world.line.rests_from_s
        if not self._moving:
            self._come_to_rest()
        return state

    def _give_way(self, state: PlantState, now_s: float) -> PlantState:
        """Once a stop has come to rest, hold the slide where it is rather than push on."""
        if now_s < self.world.line.rests_from_s:
            return state
        here = self.world.line.at(now_s).position
        self.world.drive_to(here._replace(rho3_mm=state.motors.rho3_mm), now_s)
        return self.world.advance(now_s)

    def _find_fault(self, state: PlantState, now_s: float) -> bool:
        """Latch what is wrong, if anything is."""
        pressed = [
            name
            for name, closed in zip(JOINTS, self.pressed_switches(state), strict=True)
            if closed
        ]
        error_mm = self.world.line.at(now_s).position.rho3_mm - state.motors.rho3_mm
        if pressed and self.homed:
            code = FaultCode.LIMIT_SWITCH
            detail = f"The limit switch of {' and '.join(pressed)} opened."
        elif self.state is BoardState.RUN and self.world.line.ran_empty(now_s):
            code = FaultCode.QUEUE_UNDERRUN
            detail = "The queue ran empty while the robot was moving."
        elif state.blocked_for_s >= self._numbers.stall_s:
            code = FaultCode.STALL
            detail = "The slide pushes at its force limit and does not move."
        elif abs(error_mm) > self._numbers.following_error_mm:
            code = FaultCode.FOLLOWING_ERROR
            detail = f"The slide is {abs(error_mm):.1f} mm away from where it should be."
        else:
            return False
        self.latch(code, detail, now_s)
        return True

    def _come_to_rest(self) -> None:
        if self.state is BoardState.RUN or self.state is BoardState.STOPPING:
            self.state = BoardState.READY
        if self._release_when_stopped and self.state is not BoardState.HOMING:
            self._release_when_stopped = False
            self.enabled = False
            if self.state is BoardState.READY:
                self.state = BoardState.IDLE

    # --- what it reports ---------------------------------------------------------------------

    def pressed_switches(self, state: PlantState) -> tuple[bool, bool, bool]:
        """Limit switches of rho1, rho2, rho3 as the board reads them: a cut wire is pressed."""
        margin_mm = self.world.parameters.homing.switch_margin_mm
        one, two, three = (
            cut or carriage_mm <= travel.min_mm - margin_mm
            for cut, carriage_mm, travel in zip(
                self._cut_switches, state.carriages, self.world.geometry.joint_ranges, strict=True
            )
        )
        return one, two, three

    def sample(self, now_s: float) -> RobotState:
        """One telemetry sample; ``received_at_s`` is for the link to fill in."""
        state = self.sync(now_s)
        wanted = self.world.line.at(now_s)
        return RobotState(
            sampled_at_s=now_s,
            received_at_s=now_s,
            board=self.state,
            measured=MeasuredJoints(
                encoder_reading(state.motors, self.world.parameters.drives), state.velocity
            ),
            commanded=CommandedJoints(wanted.position, wanted.velocity),
            force_n=self._force_n(state),
            enabled=self.enabled,
            homed=self.homed,
            switches=LimitSwitches(*self.pressed_switches(state)),
            queue_free=self.queue_free(now_s),
            segments_done=self.world.line.done(now_s) % SEGMENT_NUMBERS,
            fault=self.fault,
        )

    def _force_n(self, state: PlantState) -> float:
        """Motor current as a force: none with the drives off, when the brake holds."""
        if not self.enabled:
            return 0.0
        noise_n = self.world.parameters.drives.force_noise_n
        return self.world.measured_force_n(state) + float(
            self.world.streams.force.normal(0.0, noise_n)
        )

    def _why_not_ready(self) -> tuple[str, str]:
        """Stable name of the reason, and the words."""
        if self.fault is not None:
            words = f"the fault {self.fault.code.value} is latched; clear it first"
            return "fault_latched", words
        return {
            BoardState.BOOT: ("not_configured", "the board is still starting"),
            BoardState.IDLE: ("drives_off", "the drives are off; enable them first"),
            BoardState.HOMING: ("homing", "the robot is homing"),
            BoardState.STOPPING: ("stopping", "the robot is still stopping"),
            BoardState.RUN: ("moving", "the robot is moving"),
        }.get(self.state, ("refused", "the board is not ready"))
