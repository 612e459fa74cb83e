"""The listing of the settings can be read again and means the same."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest

from server.config import Option, load_configuration, load_settings
from server.config.listing import as_toml

pytestmark = pytest.mark.usefixtures("clean_environment")


def test_the_listing_read_again_is_the_same_configuration(tmp_path: Path) -> None:
    configuration = load_configuration(
        None,
        [
            Option("--host", "server.host", 'odd "name" \\ here'),
            Option("--data-dir", "storage.data_dir", tmp_path / "d"),
            Option("-", "park.x_mm", 600),
        ],
    )
    file = tmp_path / "again.toml"
    file.write_text(as_toml(configuration), encoding="utf-8")
    assert load_settings(file) == configuration.settings


def test_the_listing_names_where_a_value_was_set(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PLUGPILOT_SERVER__PORT", "8123")
    listing = as_toml(load_configuration())
    assert "port = 8123 # from environment variable PLUGPILOT_SERVER__PORT\n" in listing
    assert listing.count("# from") == 1
    assert tomllib.loads(listing)["server"]["port"] == 8123
