"""Random messages, frames and segments."""

from __future__ import annotations

from hypothesis import strategies as st

from drivers.arduino.link.frames import Frame
from drivers.arduino.protocol.message import Message
from drivers.arduino.protocol.messages import MESSAGES

bytes_0_255 = st.integers(0, 255)


@st.composite
def any_messages(draw: st.DrawFn) -> Message:
    """Any message with any content, which need not make sense."""
    kind = draw(st.sampled_from([MESSAGES[number] for number in sorted(MESSAGES)]))
    size = kind.LAYOUT.size
    return kind.unpack(draw(st.binary(min_size=size, max_size=size)))


@st.composite
def any_frames(draw: st.DrawFn) -> Frame:
    """Any frame of either side."""
    return Frame(draw(bytes_0_255), draw(bytes_0_255), draw(any_messages()))
