"""How a fake board introduces itself."""

from __future__ import annotations

from drivers.arduino.protocol import messages
from drivers.arduino.protocol.messages import TICK_HZ, State


def hello(
    *,
    protocol_hash: int,
    session: int,
    version: tuple[int, int, int],
    boot_id: int,
    state: State,
    config_crc: int,
    tick: int,
) -> messages.Hello:
    """A HELLO of a Me Auriga that was just switched on."""
    major, minor, patch = version
    return messages.Hello(
        protocol_hash=protocol_hash,
        session=session,
        board=1,
        firmware_major=major,
        firmware_minor=minor,
        firmware_patch=patch,
        boot_id=boot_id,
        reset_cause=1,
        previous_fault=0,
        state=state,
        queue_capacity=messages.QUEUE_CAPACITY,
        segment_ticks=messages.SEGMENT_TICKS,
        tick_hz=TICK_HZ,
        config_crc=config_crc,
        tick=tick,
    )
