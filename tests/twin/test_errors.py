from __future__ import annotations

import sys
from collections.abc import Iterator

import pytest

import twin.errors
import twin.kinematics
import twin.motion
import twin.scene.overlays.spread
import twin.study.optimise
import twin.workspace
from twin.errors import TwinError


def tree(root: type[TwinError]) -> Iterator[type[TwinError]]:
    yield root
    for branch in root.__subclasses__():
        yield from tree(branch)


def test_every_error_has_its_own_code() -> None:
    codes = [error.code for error in tree(TwinError)]
    assert len(codes) == len(set(codes)) >= 18


def test_every_error_says_what_to_do() -> None:
    assert all(error.remedy.endswith(".") for error in tree(TwinError))


@pytest.mark.parametrize("error", list(tree(TwinError)), ids=lambda error: error.__name__)
def test_the_drawn_tree_is_complete(error: type[TwinError]) -> None:
    drawn = twin.errors.__doc__ or ""
    assert error.__name__ in drawn
    assert error.__name__ in (sys.modules[error.__module__].__doc__ or "")
