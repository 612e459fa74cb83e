"""What a code that is not the wanted label is, in words."""

from __future__ import annotations

from collections.abc import Sequence

from server.labels.payload import parse_label_text


def why_not_the_label(found: Sequence[str], wanted: str) -> str:
    """A sentence about the codes in the picture when the wanted label is not among them."""
    return " ".join(_about(text, wanted) for text in found)


def _about(text: str, wanted: str) -> str:
    label, expected = parse_label_text(text), parse_label_text(wanted)
    if label is None:
        return f"There is another code, which says {text[:40]!r}."
    if expected is None or label.version != expected.version:
        return "There is a label of another format: print it anew with `plugpilot label`."
    if label.vehicle != expected.vehicle:
        return f"There is the label of another vehicle, {label.vehicle}."
    if not label.intact:
        return "There is a label of this vehicle with a damaged text: print it anew."
    return (
        "There is a label of this vehicle that was not made by this robot: print one with "
        "`plugpilot label` and this robot's data folder."
    )
