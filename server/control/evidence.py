"""Does what the board reports contradict what is written down about the plug?"""

from __future__ import annotations

from drivers.robot import FaultCode, RobotState
from server.control.model import PlugState
from server.control.plug_guard import PlugGuard

CORRIDOR_TOLERANCE_MM = 0.5


async def settle_plug(plug: PlugGuard, state: RobotState, *, first: bool) -> None:
    """Correct the record about the plug, always towards what forbids more.

    Args:
        plug: Keeps the record.
        state: A telemetry sample.
        first: It is the first one of a new link: what happened before it, nobody has seen.
    """
    if plug.state in {PlugState.PARKED, PlugState.FREE} and _pushed_in_vain(state):
        # Somebody may have jogged the plug into a socket.
        await plug.doubt()
    if plug.state is PlugState.PARKED and not state.homed:
        await plug.is_free()
    if plug.state is PlugState.INSERTED:
        # The way out is known in joint positions: without those it is not known.
        known = state.homed and plug.corridor is not None
        if not known or (first and not _in_corridor(plug, state)):
            await plug.doubt()


def _pushed_in_vain(state: RobotState) -> bool:
    return state.fault is not None and state.fault.code is FaultCode.STALL


def _in_corridor(plug: PlugGuard, state: RobotState) -> bool:
    corridor = plug.corridor
    return corridor is not None and corridor.holds(state.measured.position, CORRIDOR_TOLERANCE_MM)
