"""Messages between host and motion board.

Generated from messages.toml by generate.py. Do not edit.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum, IntFlag
from struct import Struct
from typing import ClassVar

from drivers.arduino.protocol.message import Message

PROTOCOL_HASH = 0x13345A36
BAUD = 500000
"""Bits per second, 8N1."""
TICK_HZ = 20000
"""Ticks per second; a stepper makes at most one step per tick."""
PHASE_BITS = 31
"""Binary digits of a position behind the point."""
AXES = 3
"""rho1, rho2, rho3."""
STEP_AXES = 2
"""The first of them are steppers."""
QUEUE_CAPACITY = 16
"""Segments the board holds, the running one included."""
SEGMENT_TICKS = 400
"""Ticks of a segment that the board is made for: 20 ms."""
MAX_SEGMENT_TICKS = 2000
"""Ticks of the longest segment."""
MAX_FRAME_BYTES = 64
"""Of an encoded frame, its delimiter included."""
WINDOW = 8
"""Sequenced messages under way before the host waits."""
RETRANSMIT_MS = 30
"""Without progress the host sends the window again."""
HEARTBEAT_PERIOD_MS = 50
"""The host sends one this often."""
HEARTBEAT_TIMEOUT_MS = 200
"""Silence after which the board stops by itself."""
TELEMETRY_MOVING_MS = 10
"""Period of the telemetry while anything moves."""
TELEMETRY_REST_MS = 100
"""Period of the telemetry at rest."""
TELEMETRY_CHANGE_MS = 2
"""A change is told at once, but not sooner after the last telemetry."""
ARRIVED_MS = 10
"""rho3 has arrived when it stood so long within config_rho3.settled."""
ARRIVAL_STANDSTILL_MS = 500
"""Standing so long elsewhere it will not arrive any more."""
ARRIVAL_TIMEOUT_MS = 3000
"""Nor will it so long after its set point has come to rest."""
HELLO_PERIOD_MS = 500
"""A board without a session says HELLO this often."""
RATE_BITS_DROPPED = 16
"""Telemetry rates are rates shifted right by this."""


class State(IntEnum):
    """What the board does."""

    BOOT = 0
    IDLE = 1
    HOMING = 2
    READY = 3
    RUN = 4
    STOPPING = 5
    FAULT = 6


class Fault(IntEnum):
    """Why the board latched a fault."""

    NONE = 0
    EMERGENCY_STOP = 1
    LIMIT_SWITCH = 2
    FOLLOWING_ERROR = 3
    STALL = 4
    QUEUE_UNDERRUN = 5
    HEARTBEAT_LOST = 6
    SEGMENT_MISMATCH = 7
    HOMING_FAILED = 8
    WATCHDOG = 9


class Refusal(IntEnum):
    """Why the board refused a sequenced message."""

    NONE = 0
    NOT_CONFIGURED = 1
    DRIVES_OFF = 2
    HOMING = 3
    MOVING = 4
    STOPPING = 5
    FAULT_LATCHED = 6
    NOT_HOMED = 7
    QUEUE_FULL = 8
    WRONG_NUMBER = 9
    BAD_TICKS = 10
    DISCONTINUOUS = 11
    RATE_JUMP = 12
    TOO_FAST = 13
    BEYOND_TRAVEL = 14
    BAD_VALUE = 15
    CAUSE_PRESENT = 16
    CONFIG_CRC = 17
    NOT_AT_REST = 18


class EventKind(IntEnum):
    """What an EVENT tells."""

    FAULT_LATCHED = 1
    HOMING_DONE = 2
    REFUSED = 3


class StopCategory(IntEnum):
    """Of IEC 60204-1."""

    DECELERATE_AND_RELEASE = 1
    DECELERATE_AND_HOLD = 2


class BoardKind(IntEnum):
    """Which hardware answers."""

    ME_AURIGA = 1


class ResetCause(IntEnum):
    """Why the board started."""

    UNKNOWN = 0
    POWER_ON = 1
    EXTERNAL = 2
    BROWN_OUT = 3
    WATCHDOG = 4


class TelemetryFlag(IntFlag):
    """Bits of telemetry.flags."""

    ENABLED = 1 << 0
    HOMED = 1 << 1
    SWITCH_RHO1 = 1 << 2
    SWITCH_RHO2 = 1 << 3
    SWITCH_RHO3 = 1 << 4
    ESTOP_OPEN = 1 << 5
    MOVING = 1 << 6
    FORCE_LIMITED = 1 << 7
    LATE_TICK = 1 << 8
    RX_OVERRUN = 1 << 9
    KEPT_DAMAGED = 1 << 10


class AxisFlag(IntFlag):
    """Bits of config_axis.flags."""

    REVERSED = 1 << 0
    SWITCH_CLOSES = 1 << 1
    ENCODER_REVERSED = 1 << 2


@dataclass(frozen=True, slots=True)
class HelloRequest(Message):
    """Begin a session: sequence numbers start at 0. The same session again changes nothing."""

    TYPE: ClassVar[int] = 0x01
    SEQUENCED: ClassVar[bool] = False
    LAYOUT: ClassVar[Struct] = Struct("<IH")
    SHAPE: ClassVar[tuple[int, ...]] = (1, 1)

    protocol_hash: int
    session: int


@dataclass(frozen=True, slots=True)
class Heartbeat(Message):
    """The host is alive. Watched from the session's start while the drives are on."""

    TYPE: ClassVar[int] = 0x02
    SEQUENCED: ClassVar[bool] = False
    LAYOUT: ClassVar[Struct] = Struct("<")
    SHAPE: ClassVar[tuple[int, ...]] = ()


@dataclass(frozen=True, slots=True)
class Clock(Message):
    """Ask for the board's time."""

    TYPE: ClassVar[int] = 0x03
    SEQUENCED: ClassVar[bool] = False
    LAYOUT: ClassVar[Struct] = Struct("<H")
    SHAPE: ClassVar[tuple[int, ...]] = (1,)

    token: int


@dataclass(frozen=True, slots=True)
class Stop(Message):
    """Drop the queue and decelerate; honoured at once in every state."""

    TYPE: ClassVar[int] = 0x04
    SEQUENCED: ClassVar[bool] = False
    LAYOUT: ClassVar[Struct] = Struct("<BB")
    SHAPE: ClassVar[tuple[int, ...]] = (1, 1)

    category: int
    token: int


@dataclass(frozen=True, slots=True)
class EmergencyStop(Message):
    """Category 1 stop, then latch a fault; honoured at once in every state."""

    TYPE: ClassVar[int] = 0x05
    SEQUENCED: ClassVar[bool] = False
    LAYOUT: ClassVar[Struct] = Struct("<BB")
    SHAPE: ClassVar[tuple[int, ...]] = (1, 1)

    fault: int
    token: int


@dataclass(frozen=True, slots=True)
class ConfigAxis(Message):
    """Configuration of one axis; with the drives off. In force from CONFIG_COMMIT."""

    TYPE: ClassVar[int] = 0x10
    SEQUENCED: ClassVar[bool] = True
    LAYOUT: ClassVar[Struct] = Struct("<BBIiiiIIIIIIII")
    SHAPE: ClassVar[tuple[int, ...]] = (1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1)

    axis: int
    flags: int
    units_per_mm_q16: int
    travel_min: int
    travel_max: int
    switch_position: int
    max_rate: int
    max_rate_jump: int
    stop_deceleration: int
    seek_rate: int
    locate_rate: int
    homing_acceleration: int
    back_off: int
    beyond_travel: int


@dataclass(frozen=True, slots=True)
class ConfigRho3(Message):
    """Configuration of the closed loop of rho3 at 1 kHz. PWM runs from -255 to 255."""

    TYPE: ClassVar[int] = 0x11
    SEQUENCED: ClassVar[bool] = True
    LAYOUT: ClassVar[Struct] = Struct("<HHHBBHHHHHHHH")
    SHAPE: ClassVar[tuple[int, ...]] = (1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1)

    kp_q8: int
    ki_q16: int
    kd_q8: int
    integral_pwm_max: int
    friction_pwm: int
    back_emf_q8: int
    pwm_per_newton_q8: int
    force_limit_dn: int
    force_max_dn: int
    stall_ms: int
    following_error: int
    settled: int
    near: int


@dataclass(frozen=True, slots=True)
class ConfigHoming(Message):
    """Homing: rho3, then rho1 and rho2 at constant height, then the rest position."""

    TYPE: ClassVar[int] = 0x12
    SEQUENCED: ClassVar[bool] = True
    LAYOUT: ClassVar[Struct] = Struct("<i3i")
    SHAPE: ClassVar[tuple[int, ...]] = (1, 3)

    carriage_sum: int
    rest_position: tuple[int, int, int]


@dataclass(frozen=True, slots=True)
class ConfigCommit(Message):
    """Put the configuration in force. BOOT becomes IDLE; homed is lost."""

    TYPE: ClassVar[int] = 0x13
    SEQUENCED: ClassVar[bool] = True
    LAYOUT: ClassVar[Struct] = Struct("<HB")
    SHAPE: ClassVar[tuple[int, ...]] = (1, 1)

    crc: int
    save: int


@dataclass(frozen=True, slots=True)
class Enable(Message):
    """Energise the drives: IDLE becomes READY."""

    TYPE: ClassVar[int] = 0x20
    SEQUENCED: ClassVar[bool] = True
    LAYOUT: ClassVar[Struct] = Struct("<")
    SHAPE: ClassVar[tuple[int, ...]] = ()


@dataclass(frozen=True, slots=True)
class Disable(Message):
    """De-energise the drives: READY becomes IDLE; refused while moving."""

    TYPE: ClassVar[int] = 0x21
    SEQUENCED: ClassVar[bool] = True
    LAYOUT: ClassVar[Struct] = Struct("<")
    SHAPE: ClassVar[tuple[int, ...]] = ()


@dataclass(frozen=True, slots=True)
class Home(Message):
    """Begin homing; READY only. Ends with HOMING_DONE or a fault or a stop."""

    TYPE: ClassVar[int] = 0x22
    SEQUENCED: ClassVar[bool] = True
    LAYOUT: ClassVar[Struct] = Struct("<")
    SHAPE: ClassVar[tuple[int, ...]] = ()


@dataclass(frozen=True, slots=True)
class ForceLimit(Message):
    """Cap the force of rho3."""

    TYPE: ClassVar[int] = 0x23
    SEQUENCED: ClassVar[bool] = True
    LAYOUT: ClassVar[Struct] = Struct("<H")
    SHAPE: ClassVar[tuple[int, ...]] = (1,)

    force_dn: int


@dataclass(frozen=True, slots=True)
class ClearFault(Message):
    """Release the latched fault; refused while moving or while its cause is present."""

    TYPE: ClassVar[int] = 0x24
    SEQUENCED: ClassVar[bool] = True
    LAYOUT: ClassVar[Struct] = Struct("<")
    SHAPE: ClassVar[tuple[int, ...]] = ()


@dataclass(frozen=True, slots=True)
class Segment(Message):
    """Append constant acceleration to the queue; READY (homed) or RUN only."""

    TYPE: ClassVar[int] = 0x25
    SEQUENCED: ClassVar[bool] = True
    LAYOUT: ClassVar[Struct] = Struct("<HH3i3I3i3i")
    SHAPE: ClassVar[tuple[int, ...]] = (1, 1, 3, 3, 3, 3)

    number: int
    ticks: int
    start: tuple[int, int, int]
    phase: tuple[int, int, int]
    rate: tuple[int, int, int]
    acceleration: tuple[int, int, int]


@dataclass(frozen=True, slots=True)
class Hello(Message):
    """Who the board is. Answers every HELLO_REQUEST; without a session sent by itself."""

    TYPE: ClassVar[int] = 0x81
    SEQUENCED: ClassVar[bool] = False
    LAYOUT: ClassVar[Struct] = Struct("<IHBBBBHBBBBHHHI")
    SHAPE: ClassVar[tuple[int, ...]] = (1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1)

    protocol_hash: int
    session: int
    board: int
    firmware_major: int
    firmware_minor: int
    firmware_patch: int
    boot_id: int
    reset_cause: int
    previous_fault: int
    state: int
    queue_capacity: int
    segment_ticks: int
    tick_hz: int
    config_crc: int
    tick: int


@dataclass(frozen=True, slots=True)
class ClockReply(Message):
    """The board's time when CLOCK was handled."""

    TYPE: ClassVar[int] = 0x82
    SEQUENCED: ClassVar[bool] = False
    LAYOUT: ClassVar[Struct] = Struct("<HI")
    SHAPE: ClassVar[tuple[int, ...]] = (1, 1)

    token: int
    tick: int


@dataclass(frozen=True, slots=True)
class Ack(Message):
    """Sent at once after every sequenced message, wanted or not, and after every stop."""

    TYPE: ClassVar[int] = 0x83
    SEQUENCED: ClassVar[bool] = False
    LAYOUT: ClassVar[Struct] = Struct("<BBBB")
    SHAPE: ClassVar[tuple[int, ...]] = (1, 1, 1, 1)

    events: int
    refused_seq: int
    refusal: int
    stop_token: int


@dataclass(frozen=True, slots=True)
class Event(Message):
    """Something happened. The frame's seq counts the EVENTs of a session, from 0."""

    TYPE: ClassVar[int] = 0x84
    SEQUENCED: ClassVar[bool] = False
    LAYOUT: ClassVar[Struct] = Struct("<BBBBI")
    SHAPE: ClassVar[tuple[int, ...]] = (1, 1, 1, 1, 1)

    kind: int
    code: int
    seq: int
    detail: int
    tick: int


@dataclass(frozen=True, slots=True)
class Telemetry(Message):
    """One sample of everything, all of the same instant."""

    TYPE: ClassVar[int] = 0x85
    SEQUENCED: ClassVar[bool] = False
    LAYOUT: ClassVar[Struct] = Struct("<IBBBH3ii3hhhhBHHHBBBBBHh")
    SHAPE: ClassVar[tuple[int, ...]] = (
        1,
        1,
        1,
        1,
        1,
        3,
        1,
        3,
        1,
        1,
        1,
        1,
        1,
        1,
        1,
        1,
        1,
        1,
        1,
        1,
        1,
        1,
    )

    tick: int
    state: int
    fault: int
    fault_detail: int
    flags: int
    commanded: tuple[int, int, int]
    measured_rho3: int
    commanded_rate: tuple[int, int, int]
    measured_rate_rho3: int
    pwm: int
    force_dn: int
    queue_used: int
    segment: int
    segment_tick: int
    next_segment: int
    bad_frames: int
    events: int
    refused_seq: int
    refusal: int
    stop_token: int
    supply_mv: int
    temperature_dc: int


MESSAGES: dict[int, type[Message]] = {
    HelloRequest.TYPE: HelloRequest,
    Heartbeat.TYPE: Heartbeat,
    Clock.TYPE: Clock,
    Stop.TYPE: Stop,
    EmergencyStop.TYPE: EmergencyStop,
    ConfigAxis.TYPE: ConfigAxis,
    ConfigRho3.TYPE: ConfigRho3,
    ConfigHoming.TYPE: ConfigHoming,
    ConfigCommit.TYPE: ConfigCommit,
    Enable.TYPE: Enable,
    Disable.TYPE: Disable,
    Home.TYPE: Home,
    ForceLimit.TYPE: ForceLimit,
    ClearFault.TYPE: ClearFault,
    Segment.TYPE: Segment,
    Hello.TYPE: Hello,
    ClockReply.TYPE: ClockReply,
    Ack.TYPE: Ack,
    Event.TYPE: Event,
    Telemetry.TYPE: Telemetry,
}
"""Every message by its number."""

FROM_HOST = frozenset(
    {
        HelloRequest.TYPE,
        Heartbeat.TYPE,
        Clock.TYPE,
        Stop.TYPE,
        EmergencyStop.TYPE,
        ConfigAxis.TYPE,
        ConfigRho3.TYPE,
        ConfigHoming.TYPE,
        ConfigCommit.TYPE,
        Enable.TYPE,
        Disable.TYPE,
        Home.TYPE,
        ForceLimit.TYPE,
        ClearFault.TYPE,
        Segment.TYPE,
    }
)
"""Numbers of what the host says."""

FROM_BOARD = frozenset(
    {
        Hello.TYPE,
        ClockReply.TYPE,
        Ack.TYPE,
        Event.TYPE,
        Telemetry.TYPE,
    }
)
"""Numbers of what the board says."""
