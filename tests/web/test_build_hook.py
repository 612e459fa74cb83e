"""When the pages are built, and with which Node."""

from __future__ import annotations

import importlib.util
import os
from pathlib import Path
from types import ModuleType
from typing import Any, Protocol

import pytest

HOOK_FILE = Path(__file__).resolve().parents[2] / "web" / "hatch_build.py"


class BuildHook(Protocol):
    """What hatchling calls."""

    def dependencies(self) -> list[str]: ...

    def initialize(self, version: str, build_data: dict[str, Any]) -> None: ...


@pytest.fixture
def hook_module() -> ModuleType:
    spec = importlib.util.spec_from_file_location("hatch_build", HOOK_FILE)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A project whose npm notes what it was told and builds a page."""
    monkeypatch.delenv("PLUGPILOT_SKIP_WEB", raising=False)
    (tmp_path / "web" / "src").mkdir(parents=True)
    (tmp_path / "web" / "src" / "main.ts").write_text("1")
    (tmp_path / "bin").mkdir()
    static = tmp_path / "server" / "static"
    _install_node(tmp_path, "v20.19.0")
    _write_program(
        tmp_path / "bin" / "npm",
        f'echo "$@" >> {tmp_path}/npm.log; mkdir -p {static}; echo page > {static}/index.html',
    )
    monkeypatch.setenv("PATH", f"{tmp_path / 'bin'}{os.pathsep}/usr/bin{os.pathsep}/bin")
    return tmp_path


def _write_program(file: Path, script: str) -> None:
    file.write_text(f"#!/bin/sh\n{script}\n")
    file.chmod(0o755)


def _install_node(project: Path, version: str) -> None:
    _write_program(project / "bin" / "node", f"echo {version}")


def _make_hook(module: ModuleType, project: Path) -> BuildHook:
    hook: BuildHook = module.WebBuildHook(str(project), {}, None, None, str(project), "wheel")
    return hook


def _npm_calls(project: Path) -> list[str]:
    log = project / "npm.log"
    return log.read_text().splitlines() if log.exists() else []


def test_pages_are_built_once_and_again_only_after_a_change(
    hook_module: ModuleType, project: Path
) -> None:
    hook = _make_hook(hook_module, project)
    hook.initialize("editable", {})
    hook.initialize("editable", {})
    assert _npm_calls(project) == ["ci", "run build"]
    (project / "web" / "src" / "main.ts").write_text("2")
    hook.initialize("editable", {})
    assert _npm_calls(project) == ["ci", "run build"] * 2


def test_a_lost_build_is_made_again(hook_module: ModuleType, project: Path) -> None:
    hook = _make_hook(hook_module, project)
    hook.initialize("standard", {})
    for file in (project / "server" / "static").iterdir():
        file.unlink()
    hook.initialize("standard", {})
    assert len(_npm_calls(project)) == 4


def test_a_failed_build_fails_the_installation_and_is_tried_again(
    hook_module: ModuleType, project: Path
) -> None:
    _write_program(project / "bin" / "npm", "exit 1")
    hook = _make_hook(hook_module, project)
    with pytest.raises(hook_module.subprocess.CalledProcessError):
        hook.initialize("standard", {})
    assert not (project / "server" / "static" / ".web-digest").exists()


def test_installed_libraries_are_no_source(hook_module: ModuleType, project: Path) -> None:
    before = hook_module.digest_sources(project / "web")
    (project / "web" / "node_modules").mkdir()
    (project / "web" / "node_modules" / "x.js").write_text("1")
    assert hook_module.digest_sources(project / "web") == before
    (project / "web" / "src" / "main.ts").rename(project / "web" / "src" / "other.ts")
    assert hook_module.digest_sources(project / "web") != before


@pytest.mark.parametrize(
    ("version", "good"),
    [("v18.20.4", False), ("v20.18.3", False), ("v20.19.0", True), ("v24.1.0", True), ("?", False)],
)
def test_node_comes_from_the_index_when_the_machines_is_too_old(
    hook_module: ModuleType, project: Path, version: str, *, good: bool
) -> None:
    _install_node(project, version)
    hook = _make_hook(hook_module, project)
    assert hook.dependencies() == ([] if good else [hook_module.NODE_PACKAGE])


def test_nothing_is_asked_for_or_built_when_told_so(
    hook_module: ModuleType, project: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    _install_node(project, "v18.20.4")
    monkeypatch.setenv("PLUGPILOT_SKIP_WEB", "1")
    hook = _make_hook(hook_module, project)
    assert hook.dependencies() == []
    hook.initialize("standard", {})
    assert _npm_calls(project) == []
