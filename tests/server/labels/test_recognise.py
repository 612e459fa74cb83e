from __future__ import annotations

import pytest

from server.labels.payload import LabelKey, label_text
from server.labels.recognise import why_not_the_label

OURS, THEIRS = LabelKey(bytes(32)), LabelKey(b"\1" * 32)
WANTED = label_text("zoe", OURS)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("https://example.org", "another code, which says 'https://example.org'"),
        (label_text("leo", OURS), "the label of another vehicle, leo"),
        (label_text("zoe", THEIRS), "was not made by this robot"),
        ("PLUGPILOT:1:zoe", "another format"),
        ("PP7:zoe:whatever", "another format"),
        ("PP2:zoe:AAAAAAAAAA", "damaged text"),
    ],
)
def test_what_else_there_is_gets_a_sentence(text: str, words: str) -> None:
    assert words in why_not_the_label([text], WANTED)


def test_several_codes_get_a_sentence_each() -> None:
    sentences = why_not_the_label(["x", label_text("leo", OURS)], WANTED)
    assert sentences.count(".") == 2
