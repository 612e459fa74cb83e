"""An energy counter that never counts backwards, made of the stations' counters of a session."""

from __future__ import annotations

from dataclasses import replace

from server.storage.charge_point import ChargePointRecord


def counted(record: ChargePointRecord, session_wh: float) -> ChargePointRecord:
    """Add what has flowed since the last reading.

    A station begins at zero with every car, so less than before means a new session.

    Args:
        record: With the reading before.
        session_wh: The session's energy now [Wh].
    """
    if session_wh == record.session_wh:
        return record
    new_session = session_wh < record.session_wh
    flowed_wh = session_wh if new_session else session_wh - record.session_wh
    return replace(record, energy_wh=record.energy_wh + flowed_wh, session_wh=session_wh)
