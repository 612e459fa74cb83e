"""What a reading of the charging station must say before the plug may move in its socket."""

from __future__ import annotations

from drivers.station import PilotState, StationCapabilities, StationSnapshot
from server.control.errors import ControlError, StationUnsafeError, StillUnderLoadError

NO_CURRENT_A = 0.5
NO_POWER_W = 115.0
"""The same in one phase of 230 V; a station that shows power but no current has a broken meter."""

AHEAD_S = 0.05
"""A reading from further in the future has a time that nobody can trust."""


def why_not_safe(
    snapshot: StationSnapshot,
    capabilities: StationCapabilities,
    now_s: float,
    *,
    age_limit_s: float,
) -> ControlError | None:
    """What a reading has against moving the plug now; None proves that it is safe.

    Args:
        snapshot: The reading.
        capabilities: Of the station. One whose readings are not fresh never proves anything.
        now_s: Event loop time.
        age_limit_s: Older readings say nothing about now.
    """
    if not capabilities.fresh:
        return StationUnsafeError(
            "The readings of this charging station are too old to prove that no current flows. "
            "Configure the station itself as station.driver and its manager as station.manager."
        )
    age_s = now_s - snapshot.sampled_at_s
    if not -AHEAD_S <= age_s <= age_limit_s:
        return StationUnsafeError(
            f"The newest reading of the charging station is {age_s:.1f} s old.",
            age_s=round(age_s, 1),
        )
    # Enabled while it sees the car, a station may give power at any moment.
    is_ready = capabilities.switches and snapshot.enabled and snapshot.pilot is not PilotState.A
    if _may_carry_load(snapshot) or is_ready:
        return _under_load(snapshot)
    return None


def _may_carry_load(snapshot: StationSnapshot) -> bool:
    # Written so that a value that is no number counts as load.
    no_current = all(abs(current_a) < NO_CURRENT_A for current_a in snapshot.currents_a)
    no_power = abs(snapshot.power_w) < NO_POWER_W
    return snapshot.carries_load or not no_current or not no_power


def _under_load(snapshot: StationSnapshot) -> StillUnderLoadError:
    current_a = round(max(snapshot.currents_a), 2)
    return StillUnderLoadError(
        f"The charging station gives {current_a:.1f} A or is about to "
        f"(state {snapshot.pilot.value}).",
        current_a=current_a,
        power_w=round(snapshot.power_w, 1),
        pilot=snapshot.pilot.value,
    )
