"""What goes wrong with cable, host, board, motors and switches, and how it is mended."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from dataclasses import dataclass

from tests.rig.rig import Rig

Action = Callable[[Rig], Awaitable[object]]

SHARE = 5e-4
"""Of bytes that a bad cable spoils: one frame in 40."""

DELAY_S = 0.02
SHORT_S = 1.0
HANG_S = 0.6


@dataclass(frozen=True, slots=True)
class FaultCase:
    """One fault.

    Attributes:
        name: Of it.
        begin: Makes it.
        mend: Takes it away.
        lasts_s: Until it is mended by itself; None: somebody has to.
        harmless: Whatever goes on goes on to its end.
    """

    name: str
    begin: Action
    mend: Action
    lasts_s: float | None = None
    harmless: bool = False


async def nothing(_: Rig) -> None:
    """It has passed by itself."""


def _switch(axis: int, joint: str) -> tuple[FaultCase, FaultCase]:
    def whole(rig: Rig) -> Awaitable[object]:
        return rig.control.spoil_switch(axis, "whole")

    return (
        FaultCase(f"switch of {joint} cut", lambda r: r.control.spoil_switch(axis, "cut"), whole),
        FaultCase(
            f"switch of {joint} stuck", lambda r: r.control.spoil_switch(axis, "stuck"), whole
        ),
    )


def _whole_cable(rig: Rig) -> Awaitable[object]:
    return rig.control.spoil_link()


FAULTS = (
    FaultCase(
        "bytes lost", lambda r: r.control.spoil_link(lose=SHARE), _whole_cable, harmless=True
    ),
    FaultCase(
        "bytes flipped", lambda r: r.control.spoil_link(flip=SHARE), _whole_cable, harmless=True
    ),
    FaultCase(
        "bytes doubled",
        lambda r: r.control.spoil_link(duplicate=SHARE),
        _whole_cable,
        harmless=True,
    ),
    FaultCase(
        "bytes late", lambda r: r.control.spoil_link(delay_s=DELAY_S), _whole_cable, harmless=True
    ),
    FaultCase(
        "link cut",
        lambda r: r.control.cut_link(),
        lambda r: r.control.cut_link(cut=False),
        lasts_s=SHORT_S,
    ),
    FaultCase(
        "USB unplugged", lambda r: r.control.unplug(), lambda r: r.control.plug_in(), SHORT_S
    ),
    FaultCase("heartbeat stopped", lambda r: r.stall_host(HANG_S), nothing),
    FaultCase("reset", lambda r: r.control.reset(), nothing),
    FaultCase("power cycle", lambda r: r.control.reset(power=True), nothing),
    FaultCase("firmware hung", lambda r: r.control.hang(), nothing),
    *_switch(0, "rho1"),
    *_switch(1, "rho2"),
    *_switch(2, "rho3"),
    FaultCase(
        "encoder dead",
        lambda r: r.control.kill_encoder(),
        lambda r: r.control.kill_encoder(dead=False),
    ),
    FaultCase("motor jammed", lambda r: r.control.jam(), lambda r: r.control.jam(jammed=False)),
    FaultCase(
        "emergency stop",
        lambda r: r.control.press_stop_button(),
        lambda r: r.control.press_stop_button(pressed=False),
    ),
)
