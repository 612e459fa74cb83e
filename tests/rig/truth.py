"""What the simulator tells about the true state of board and motors."""

from __future__ import annotations

from typing import NamedTuple

from pydantic import BaseModel, ConfigDict


class _Answer(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid")


class TrueState(_Answer):
    """Where everything truly is.

    Attributes:
        at_s: When, in the time of the event loop.
        simulated_s: When, in simulated time since the start.
        rho1_steps: True position of the carriage in microsteps.
        rho2_steps: The same.
        rho3_mm: True position of the slide.
        rho3_mm_s: Its velocity.
        load_n: Force against the slide's screw, positive against going out.
        pwm: What the bridge gets.
        power: The motors have power.
        relay: The firmware lets them have it.
        pressed: Limit switches of rho1, rho2, rho3.
        resets: Of the microcontroller so far.
    """

    at_s: float
    simulated_s: float
    rho1_steps: int
    rho2_steps: int
    rho3_mm: float
    rho3_mm_s: float
    load_n: float
    pwm: int
    power: bool
    relay: bool
    pressed: tuple[bool, bool, bool]
    resets: int


class RailStatistics(_Answer):
    """What a stepper driver has seen; times are 0 before there are any.

    Attributes:
        steps: Pulses.
        lost: Of them, those that moved nothing: against a stop, or without power.
        shortest_pulse_us: STEP high.
        shortest_set_up_us: From a change of DIR to STEP.
        shortest_interval_us: Between two steps.
    """

    steps: int
    lost: int
    shortest_pulse_us: float
    shortest_set_up_us: float
    shortest_interval_us: float


class Statistics(_Answer):
    """What tick and line have been like since ``forget``; counts of bytes are never forgotten.

    Attributes:
        ticks: Step interrupts.
        late_ticks: Of them, those that began more than half a tick after their time.
        tick_interval_us: Shortest and longest between two of them.
        longest_tick_us: Duration of the interrupt.
        rounds: Of the closed loop of rho3, nominally one a millisecond.
        longest_round_us: Between two of them.
        tick_share: Of the CPU's time, in this interrupt.
        awake_share: Of the CPU's time, not asleep.
        overruns: Bytes that the UART lost.
        wrong_baud: Bytes that came at another speed.
        bytes_to_board: From the host.
        bytes_to_host: From the board.
        lost: Bytes that the cable has lost, both ways.
        flipped: Bytes of which it has turned a bit.
        duplicated: Bytes that came out of it twice.
        delayed: Bytes that it has held up.
        rails: The steppers of rho1 and rho2.
    """

    ticks: int
    late_ticks: int
    tick_interval_us: tuple[float, float]
    longest_tick_us: float
    rounds: int
    longest_round_us: float
    tick_share: float
    awake_share: float
    overruns: int
    wrong_baud: int
    bytes_to_board: int
    bytes_to_host: int
    lost: int
    flipped: int
    duplicated: int
    delayed: int
    rails: tuple[RailStatistics, RailStatistics]


class Step(NamedTuple):
    """One step of a carriage.

    Attributes:
        at_s: Simulated time since the start.
        tick: Step interrupts begun since the reset, the one that made it included.
        position: In microsteps, after it.
    """

    at_s: float
    tick: int
    position: int
