from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from server.labels.errors import LabelKeyError
from server.labels.key_file import FILE_NAME, load_label_key


def test_the_key_is_made_once_and_kept(tmp_path: Path) -> None:
    folder = tmp_path / "data"
    key = load_label_key(folder)
    assert load_label_key(folder) == key
    assert load_label_key(tmp_path / "other") != key
    assert (folder / FILE_NAME).stat().st_mode & 0o777 == 0o600
    assert [path.name for path in folder.iterdir()] == [FILE_NAME]


def test_two_starters_agree_on_one_key(tmp_path: Path) -> None:
    with ThreadPoolExecutor(8) as pool:
        keys = list(pool.map(lambda _: load_label_key(tmp_path), range(32)))
    assert len({key.secret for key in keys}) == 1


def test_without_a_folder_every_key_is_new() -> None:
    assert load_label_key(None) != load_label_key(None)


def test_a_key_that_others_can_read_is_not_used(tmp_path: Path) -> None:
    load_label_key(tmp_path)
    (tmp_path / FILE_NAME).chmod(0o644)
    with pytest.raises(LabelKeyError, match="Others can read"):
        load_label_key(tmp_path)


@pytest.mark.parametrize("text", ["", "abcd", "z" * 64, "00" * 33])
def test_a_broken_key_is_not_overwritten(tmp_path: Path, text: str) -> None:
    path = tmp_path / FILE_NAME
    path.write_text(text)
    path.chmod(0o600)
    with pytest.raises(LabelKeyError, match="64 hexadecimal digits"):
        load_label_key(tmp_path)
    assert path.read_text() == text


def test_a_folder_that_is_a_file_is_told(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(LabelKeyError, match="cannot be read or made"):
        load_label_key(tmp_path / "file")
