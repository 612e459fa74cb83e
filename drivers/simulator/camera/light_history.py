"""The ambient light of the recent past: a lamp is switched, clouds come and go."""

from __future__ import annotations

from bisect import bisect_right

_LONGEST = 256


class LightHistory:
    """Ambient light over the configured one, constant from change to change."""

    def __init__(self) -> None:
        self._changed_at_s = [float("-inf")]
        self._light = [1.0]

    @property
    def newest(self) -> float:
        """What it is since the last change."""
        return self._light[-1]

    def change(self, at_s: float, light: float) -> None:
        """The light is another one from a time on, which is after all changes before.

        Raises:
            ValueError: it is negative or not a number.
        """
        if not 0 <= light < float("inf"):
            raise ValueError(f"light must be 0 or more, not {light}")
        self._changed_at_s.append(at_s)
        self._light.append(light)
        del self._changed_at_s[:-_LONGEST], self._light[:-_LONGEST]

    def at(self, t_s: float) -> float:
        """The light at a time."""
        return self._light[max(bisect_right(self._changed_at_s, t_s) - 1, 0)]
