"""A motion board in Python that speaks the real protocol: what the driver is tested against.

It has no drives: the joints are where the set points are. Time is given from outside.
"""

from __future__ import annotations

import random
from collections.abc import Callable

from drivers.arduino.link.frames import Frame, FrameReader, encode_frame
from drivers.arduino.link.go_back_n import Receiver
from drivers.arduino.protocol import messages
from drivers.arduino.protocol.message import Message
from drivers.arduino.protocol.messages import (
    FROM_HOST,
    PROTOCOL_HASH,
    RATE_BITS_DROPPED,
    TICK_HZ,
    EventKind,
    Fault,
    Refusal,
    State,
    TelemetryFlag,
)
from tests.support.fake_configuration import FakeConfiguration
from tests.support.fake_hello import hello
from tests.support.fake_queue import FakeQueue, whole_units
from tests.support.fake_refusals import NOT_READY

HOMING_TICKS = HELLO_TICKS = TICK_HZ // 20
"""A test does not want to wait for half a second."""


class FakeBoard:
    """The firmware as the protocol describes it.

    Args:
        send: Takes bytes for the host.
        protocol_hash: Of the definition it claims to follow.
        loss: Share of frames that are lost in each direction.
    """

    def __init__(
        self,
        send: Callable[[bytes], None],
        *,
        protocol_hash: int = PROTOCOL_HASH,
        loss: float = 0.0,
    ) -> None:
        self._send_bytes = send
        self._hash = protocol_hash
        self.loss = loss
        self._rng = random.Random(7)
        self._frames = FrameReader(FROM_HOST)
        self._boot_id = 0
        self.mute = False
        self.heard: list[Message] = []
        self.refuse_next: Refusal | None = None
        self.events_to_lose = 0
        self.version = (1, 2, 3)
        self.stop_button = self.echo = False
        self.chatter = b""
        self.restart()

    def restart(self) -> None:
        """As if the power had come back."""
        self._boot_id += 1
        self.state = State.BOOT
        self.fault = Fault.NONE
        self.enabled = self.homed = False
        self._config = FakeConfiguration()
        self.queue = FakeQueue()
        self.force_limit_dn = 0
        self._release = False
        self._tick = self._due = self._hello_due = self._heard_tick = self._homing_until = 0
        self._shown: tuple[object, ...] = ()
        self._begin_session(0)

    def _begin_session(self, session: int) -> None:
        self._session = session
        self._receiver = Receiver()
        self._events = self._refused_seq = self._stop_token = 0
        self._refusal = Refusal.NONE
        self.queue.begin_session()

    # --- time --------------------------------------------------------------------------------

    def advance(self, tick: int) -> None:
        """Let the board live until a tick."""
        self._tick = tick
        if self.chatter:
            self._send_bytes(self.chatter)
        self._follow()
        timeout = messages.HEARTBEAT_TIMEOUT_MS * TICK_HZ // 1000
        if self._session and self.enabled and tick - self._heard_tick > timeout:
            self._heard_tick = tick
            self._latch(Fault.HEARTBEAT_LOST, release=True)
        if self.state is State.HOMING and tick >= self._homing_until:
            self.queue.place(self._config.homing.rest_position)
            self.homed, self.state = True, State.READY
            self._event(EventKind.HOMING_DONE)
        self._report()

    def _follow(self) -> None:
        braked = self.queue.braking
        end = self.queue.follow(self._tick)
        if end is None:
            return
        if braked:
            if self.state is State.STOPPING:
                self.state = State.READY
            self._release_drives()
        elif max(map(abs, end.rate)) > self._config.rho1.max_rate_jump:
            self._latch(Fault.QUEUE_UNDERRUN, release=False)
        else:
            self.state = State.READY

    def _release_drives(self) -> None:
        if self._release:
            self._release = self.enabled = False
            if self.state is State.READY:
                self.state = State.IDLE

    @property
    def _moving(self) -> bool:
        return self.queue.running is not None or self.state is State.HOMING

    def _stop(self, *, release: bool) -> None:
        self._release = self._release or release
        self.queue.brake(self._tick)
        if self.queue.braking:
            self.state = State.STOPPING if self.state is State.RUN else self.state
            return
        self.state = State.READY if self.state is State.HOMING else self.state
        self._release_drives()

    def _latch(self, fault: Fault, *, release: bool) -> None:
        self._stop(release=release)
        if self.fault is Fault.NONE:
            self.fault = fault
            self._event(EventKind.FAULT_LATCHED, fault)
        if fault is Fault.SEGMENT_MISMATCH:
            self.homed = False
        self.state = State.FAULT

    def press_stop_button(self, *, pressed: bool = True) -> None:
        """The emergency stop."""
        self.stop_button = pressed
        if pressed:
            self._latch(Fault.EMERGENCY_STOP, release=True)
            self.homed = False

    # --- what it hears -----------------------------------------------------------------------

    def hear(self, data: bytes) -> None:
        """Take bytes of the host."""
        if self.echo:
            self._send_bytes(data)
        for frame in self._frames.feed(data):
            if self._rng.random() >= self.loss:
                self._heard_tick = self._tick
                self._handle(frame)

    def _handle(self, frame: Frame) -> None:
        message = frame.message
        if message.SEQUENCED:
            if self._session and self._receiver.accept(frame.seq):
                self.heard.append(message)
                refusal, self.refuse_next = self.refuse_next, None
                refusal = refusal or self._obey(message)
                if refusal is not Refusal.NONE:
                    self._refusal, self._refused_seq = refusal, frame.seq
                    self._event(EventKind.REFUSED, refusal, frame.seq)
            self._acknowledge()
            return
        match message:
            case messages.HelloRequest(protocol_hash=protocol_hash, session=session):
                understood = protocol_hash == self._hash
                if understood and session != self._session:
                    self._stop(release=False)
                    self._begin_session(session)
                self._hello(session)
            case messages.Clock(token=token):
                self._send(messages.ClockReply(token=token, tick=self._tick))
            case messages.Stop(category=category, token=token):
                self._stop_token = token
                self._stop(release=category == 1)
                self._acknowledge()
            case messages.EmergencyStop(fault=fault, token=token):
                self._stop_token = token
                mismatch = fault == Fault.SEGMENT_MISMATCH
                self._latch(
                    Fault.SEGMENT_MISMATCH if mismatch else Fault.EMERGENCY_STOP, release=True
                )
                self._acknowledge()

    def _obey(self, message: Message) -> Refusal:
        match message:
            case messages.ConfigAxis() | messages.ConfigRho3() | messages.ConfigHoming():
                return self._configure(message)
            case messages.ConfigCommit(crc=crc):
                return self._commit(crc)
            case messages.Enable():
                return self._enable()
            case messages.Disable():
                return self._disable()
            case messages.Home():
                if self.state is not State.READY:
                    return NOT_READY[self.state]
                self.state, self.homed = State.HOMING, False
                self._homing_until = self._tick + HOMING_TICKS
            case messages.ForceLimit(force_dn=force_dn):
                self.force_limit_dn = force_dn
            case messages.ClearFault():
                if self._moving:
                    return Refusal.MOVING
                if self.fault is not Fault.NONE and self.stop_button:
                    return Refusal.CAUSE_PRESENT
                if self.fault is not Fault.NONE:
                    self.fault = Fault.NONE
                    self.state = State.READY if self.enabled else State.IDLE
            case messages.Segment():
                return self._append(message)
        return Refusal.NONE

    def _configure(self, part: Message) -> Refusal:
        if self.enabled or self._moving:
            return Refusal.NOT_AT_REST
        self._config.put(part)
        return Refusal.NONE

    def _commit(self, crc: int) -> Refusal:
        refusal = self._config.commit(crc)
        if refusal is Refusal.NONE:
            self.state = State.IDLE if self.state is State.BOOT else self.state
            self.homed = False
        return refusal

    def _enable(self) -> Refusal:
        if self.state in {State.BOOT, State.FAULT}:
            return NOT_READY[self.state]
        self.enabled = True
        self.state = State.READY if self.state is State.IDLE else self.state
        return Refusal.NONE

    def _disable(self) -> Refusal:
        if self._moving:
            return Refusal.MOVING
        self.enabled = False
        self.state = State.IDLE if self.state is State.READY else self.state
        return Refusal.NONE

    def _append(self, segment: messages.Segment) -> Refusal:
        if self.state not in {State.READY, State.RUN}:
            return NOT_READY[self.state]
        if not self.homed:
            return Refusal.NOT_HOMED
        refusal = self.queue.append(segment, self._tick, self._config.rho1)
        if refusal is Refusal.NONE:
            self.state = State.RUN
        return refusal

    # --- what it says ------------------------------------------------------------------------

    def _send(self, message: Message, seq: int = 0) -> None:
        if self.mute or self._rng.random() < self.loss:
            return
        self._send_bytes(encode_frame(Frame(seq, self._receiver.expected, message)))

    def _event(self, kind: EventKind, code: int = 0, seq: int = 0) -> None:
        number = self._events
        self._events = (self._events + 1) % 256
        if self.events_to_lose:
            self.events_to_lose -= 1
            return
        self._send(messages.Event(kind, code, seq, 0, self._tick), number)

    def _acknowledge(self) -> None:
        self._send(messages.Ack(self._events, self._refused_seq, self._refusal, self._stop_token))

    def _hello(self, session: int) -> None:
        self._send(
            hello(
                protocol_hash=self._hash,
                session=session,
                version=self.version,
                boot_id=self._boot_id,
                state=self.state,
                config_crc=self._config.crc,
                tick=self._tick,
            )
        )

    def _report(self) -> None:
        if not self._session:
            if self._tick >= self._hello_due:
                self._hello_due = self._tick + HELLO_TICKS
                self._hello(0)
            return
        shown = (self.state, self.fault, self._flags())
        if self._tick >= self._due or shown != self._shown:
            period_ms = messages.TELEMETRY_REST_MS
            if self._moving:
                period_ms = messages.TELEMETRY_MOVING_MS
            self._due = self._tick + period_ms * TICK_HZ // 1000
            self._shown = shown
            self._send(self._telemetry())

    def _flags(self) -> TelemetryFlag:
        flags = TelemetryFlag(0)
        if self.enabled:
            flags |= TelemetryFlag.ENABLED
        if self.homed:
            flags |= TelemetryFlag.HOMED
        if self._moving:
            flags |= TelemetryFlag.MOVING
        if self.stop_button:
            flags |= TelemetryFlag.ESTOP_OPEN
        return flags

    def _telemetry(self) -> messages.Telemetry:
        point = self.queue.point(self._tick)
        commanded = whole_units(point.position)
        r1, r2, r3 = (rate >> RATE_BITS_DROPPED for rate in point.rate)
        queued = self.queue.segments
        return messages.Telemetry(
            tick=self._tick,
            state=self.state,
            fault=self.fault,
            fault_detail=0,
            flags=self._flags(),
            commanded=commanded,
            measured_rho3=commanded[2],
            commanded_rate=(r1, r2, r3),
            measured_rate_rho3=r3,
            pwm=0,
            force_dn=123,
            queue_used=len(queued),
            segment=queued[0].number if queued else self.queue.next_number,
            segment_tick=self.queue.ticks_done(self._tick),
            next_segment=self.queue.next_number,
            bad_frames=self._frames.damaged % 256,
            events=self._events,
            refused_seq=self._refused_seq,
            refusal=self._refusal,
            stop_token=self._stop_token,
            supply_mv=12_000,
            temperature_dc=251,
        )
