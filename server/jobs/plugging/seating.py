"""Is the plug fully in?"""

from __future__ import annotations

from server.config.insertion import InsertionSettings
from server.jobs.plugging.pushing import Push


def is_seated(push: Push, settings: InsertionSettings) -> bool:
    """Whether the plug has come to its place.

    Either it reached the depth, or it met a hard stop just before. The second is needed because the
    depth is counted from the measured face, which may be some tenths of a millimetre off, while the
    socket's own end stop is where it is. It is safe to take it for the seat when

    - the plug is within the depth tolerance: the pilot contact, the last one to close, is closed
      well before that;
    - on the way the force stayed in its band, so that all contacts have gone over their springs: an
      obstacle in the mouth, or a plug that hangs on one contact, is never that deep;
    - the force rose several times as steeply as any contact rubs. Only the flange, or the ground of
      the socket, is that stiff.

    It is not the last word: nothing is switched on before the station confirms the car.
    """
    short_mm = settings.depth_mm - push.depth_mm
    if abs(short_mm) > settings.depth_tolerance_mm:
        return False
    if push.hindrance is None:
        return True
    if push.met_nothing:
        return False
    return push.curve.final_stiffness_n_mm() >= settings.end_stop_stiffness_n_mm
