from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from server.labels.errors import LabelNameError
from server.labels.payload import LabelKey, LabelText, label_text, parse_label_text
from twin.qr_label import label_modules

OURS, THEIRS = LabelKey(bytes(range(32))), LabelKey(b"another installation's own secret")
IDS = st.from_regex(r"[A-Za-z0-9][A-Za-z0-9._-]{0,63}", fullmatch=True)


def test_the_format_stays_as_it_is_printed() -> None:
    assert label_text("zoe", OURS) == "PP2:zoe:4NG43RRFJW"


@given(IDS)
def test_a_label_says_whose_it_is(vehicle: str) -> None:
    assert parse_label_text(label_text(vehicle, OURS)) == LabelText(2, vehicle, intact=True)


@given(IDS)
def test_another_installation_prints_another_text(vehicle: str) -> None:
    assert label_text(vehicle, THEIRS) != label_text(vehicle, OURS)


@given(IDS, st.data())
def test_a_changed_character_is_another_text_and_mostly_damaged(
    vehicle: str, data: st.DataObject
) -> None:
    text = label_text(vehicle, OURS)
    place = data.draw(st.integers(0, len(text) - 11))
    other = data.draw(st.characters(codec="ascii").filter(lambda c: c != text[place]))
    found = parse_label_text(text[:place] + other + text[place + 1 :])
    assert found is None or found != LabelText(2, vehicle, intact=True)


def test_swapped_vehicles_are_noticed_by_the_check_value() -> None:
    text = label_text("zoe", OURS).replace("zoe", "leo")
    assert parse_label_text(text) == LabelText(2, "leo", intact=False)


@pytest.mark.parametrize("text", ["", "https://example.org", "WIFI:S:home;;", "pp2:zoe:AA", "PP:x"])
def test_other_codes_are_no_labels(text: str) -> None:
    assert parse_label_text(text) is None


@pytest.mark.parametrize(
    ("text", "version"), [("PLUGPILOT:1:zoe", 1), ("PP1:zoe:4NUMAE4L2Q", 1), ("PP3:zoe:any", 3)]
)
def test_other_formats_are_told_by_their_version(text: str, version: int) -> None:
    assert parse_label_text(text) == LabelText(version)


@pytest.mark.parametrize("text", ["PP2:zoe", "PP2::AAAAAAAAAA", "PP2:zoe:AAAAAAAAA"])
def test_incomplete_labels_are_not_intact(text: str) -> None:
    assert parse_label_text(text) == LabelText(2)


@pytest.mark.parametrize("vehicle", ["", "-x", "a b", "a:b", "x" * 65, "zo\u00eb"])
def test_impossible_ids_are_refused(vehicle: str) -> None:
    with pytest.raises(LabelNameError):
        label_text(vehicle, OURS)


def test_a_short_id_fits_into_the_small_code() -> None:
    assert label_modules(label_text("abcde", OURS)).shape == (25, 25)


def test_the_key_is_not_shown() -> None:
    assert "00" not in repr(OURS)
    assert "another" not in repr(THEIRS)
