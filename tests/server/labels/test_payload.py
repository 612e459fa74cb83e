from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from server.labels.errors import (
    DamagedTextError,
    ForeignLabelError,
    ForeignTextError,
    LabelError,
    LabelNameError,
    OldLabelError,
)
from server.labels.payload import LabelKey, label_text, read_label_text
from twin.qr_label import label_modules

OURS, THEIRS = LabelKey(bytes(range(32))), LabelKey(b"another installation's own secret")
IDS = st.from_regex(r"[A-Za-z0-9][A-Za-z0-9._-]{0,63}", fullmatch=True)


def test_the_format_stays_as_it_is_printed() -> None:
    assert label_text("zoe", OURS) == "PP2:zoe:4NG43RRFJW"


@given(IDS)
def test_a_label_says_whose_it_is(vehicle: str) -> None:
    assert read_label_text(label_text(vehicle, OURS), OURS) == vehicle


@given(IDS)
def test_a_label_of_another_installation_is_noticed(vehicle: str) -> None:
    with pytest.raises(ForeignLabelError, match=r"another key"):
        read_label_text(label_text(vehicle, THEIRS), OURS)


@given(IDS, st.data())
def test_a_changed_character_is_noticed(vehicle: str, data: st.DataObject) -> None:
    text = label_text(vehicle, OURS)
    place = data.draw(st.integers(0, len(text) - 1))
    other = data.draw(st.characters(codec="ascii").filter(lambda c: c != text[place]))
    with pytest.raises(LabelError):
        read_label_text(text[:place] + other + text[place + 1 :], OURS)


def test_swapped_vehicles_are_noticed_by_the_check_value() -> None:
    text = label_text("zoe", OURS).replace("zoe", "leo")
    with pytest.raises(DamagedTextError):
        read_label_text(text, OURS)


@pytest.mark.parametrize("text", ["", "https://example.org", "WIFI:S:home;;", "pp2:zoe:AA", "PP:x"])
def test_other_codes_are_called_so(text: str) -> None:
    with pytest.raises(ForeignTextError):
        read_label_text(text, OURS)


@pytest.mark.parametrize("text", ["PLUGPILOT:1:zoe", "PP3:zoe:whatever", "PP1:zoe:4NUMAE4L2Q"])
def test_other_formats_are_called_so(text: str) -> None:
    with pytest.raises(OldLabelError):
        read_label_text(text, OURS)


@pytest.mark.parametrize("text", ["PP2:zoe", "PP2::AAAAAAAAAA", "PP2:zoe:AAAAAAAAA"])
def test_incomplete_labels_are_called_damaged(text: str) -> None:
    with pytest.raises(DamagedTextError):
        read_label_text(text, OURS)


@pytest.mark.parametrize("vehicle", ["", "-x", "a b", "a:b", "x" * 65, "zo\u00eb"])
def test_impossible_ids_are_refused(vehicle: str) -> None:
    with pytest.raises(LabelNameError):
        label_text(vehicle, OURS)


def test_a_short_id_fits_into_the_small_code() -> None:
    assert label_modules(label_text("abcde", OURS)).shape == (25, 25)


def test_the_key_is_not_shown() -> None:
    assert "00" not in repr(OURS)
    assert "another" not in repr(THEIRS)
