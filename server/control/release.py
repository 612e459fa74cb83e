"""What must be so before a stop may end, each condition with its name and words."""

from __future__ import annotations

from dataclasses import dataclass

from drivers.robot import RobotState
from server.config.supervision import SupervisionSettings
from server.control.board import MOVING
from server.control.plug_guard import HELD, PlugGuard
from server.control.standstill import AT_REST_MM_S


@dataclass(frozen=True, slots=True)
class ReleaseCondition:
    """One thing that must be so.

    Attributes:
        code: Stable name.
        met: It is so.
        words: What is missing, or that it is there.
    """

    code: str
    met: bool
    words: str


def release_conditions(
    state: RobotState | None, now_s: float, settings: SupervisionSettings
) -> list[ReleaseCondition]:
    """Everything that is looked at before a stop is released, whoever asks for it.

    Args:
        state: The newest sample, None while the link is down.
        now_s: Event loop time.
        settings: What counts as old.
    """
    if state is None:
        return [ReleaseCondition("link", met=False, words="The motion board does not answer.")]
    age_s = now_s - state.sampled_at_s
    still = (
        max(abs(v) for v in state.measured.velocity) < AT_REST_MM_S and state.board not in MOVING
    )
    return [
        ReleaseCondition("link", met=True, words="The motion board answers."),
        ReleaseCondition(
            "fresh",
            met=age_s <= settings.telemetry_age_s,
            words=f"The newest news of the robot are {1e3 * age_s:.0f} ms old.",
        ),
        ReleaseCondition(
            "standstill",
            met=still,
            words="The robot stands still." if still else "The robot has not come to rest yet.",
        ),
    ]


def is_harmless(plug: PlugGuard) -> bool:
    """Nothing can be hurt when a stop ends by itself: no motion begins, and the plug is free."""
    return plug.state not in HELD
