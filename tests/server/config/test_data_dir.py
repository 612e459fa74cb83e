"""The folder of the database."""

from __future__ import annotations

import stat
from pathlib import Path

import pytest

from server.config import DataDirError, prepare_data_dir


def test_a_missing_folder_is_made_for_its_owner_only(tmp_path: Path) -> None:
    path = prepare_data_dir(tmp_path / "deep" / "data")
    assert stat.S_IMODE(path.stat().st_mode) == 0o700
    assert list(path.iterdir()) == []


def test_a_folder_that_exists_keeps_its_permissions(tmp_path: Path) -> None:
    (tmp_path / "data").mkdir(mode=0o755)
    assert stat.S_IMODE(prepare_data_dir(tmp_path / "data").stat().st_mode) == 0o755


def test_a_relative_path_becomes_absolute(clean_environment: Path) -> None:
    assert prepare_data_dir(Path("data")) == clean_environment / "data"


@pytest.mark.parametrize("path", ["taken", "taken/data", "/proc/plugpilot"])
def test_a_path_that_cannot_be_a_folder_is_refused(clean_environment: Path, path: str) -> None:
    (clean_environment / "taken").write_text("a file")
    with pytest.raises(DataDirError) as caught:
        prepare_data_dir(Path(path))
    assert caught.value.code == "data_dir_unwritable"
    assert path in caught.value.detail
    assert "--data-dir" in caught.value.remedy
