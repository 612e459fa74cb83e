"""The lock files belong to pyproject.toml, and the package contains what it should."""

from __future__ import annotations

import re
import sys
import tomllib
from importlib.metadata import packages_distributions
from pathlib import Path
from typing import Any

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name
from packaging.version import Version

from tests.support.imports import arrows_in

PROJECT = Path(__file__).parents[1]
ROOMS = ("server", "drivers", "twin")
PARTS_OF = {
    "h11": "uvicorn",
    "pydantic-core": "pydantic",
    "starlette": "fastapi",
    "typing-extensions": "pydantic",
}
"""Libraries that another one brings along and shows in its own interface."""


def pyproject() -> dict[str, Any]:
    return tomllib.loads((PROJECT / "pyproject.toml").read_text(encoding="utf-8"))


def pins(lock: str) -> dict[str, list[Version]]:
    """The versions that a lock file pins; several where they depend on the Python."""
    found: dict[str, list[Version]] = {}
    text = (PROJECT / lock).read_text(encoding="utf-8")
    for name, version in re.findall(r"^([a-z0-9][\w.-]*)==([^\s;\\]+)", text, re.MULTILINE):
        found.setdefault(name, []).append(Version(version))
    return found


def wanted(lock: str) -> list[Requirement]:
    """What pyproject.toml asks for in a lock file."""
    data = pyproject()
    groups = data["dependency-groups"]
    lines = {
        "requirements.lock": data["project"]["dependencies"] + groups["build"],
        "requirements-dev.lock": data["project"]["dependencies"] + groups["build"] + groups["dev"],
        "requirements-node.lock": groups["node"],
        "requirements-audit.lock": groups["audit"],
    }
    return [Requirement(line) for line in lines[lock]]


def test_everything_that_is_imported_is_required() -> None:
    required = {
        canonicalize_name(Requirement(d).name) for d in pyproject()["project"]["dependencies"]
    }
    distributions = packages_distributions()
    missing = set()
    for arrow in arrows_in(PROJECT, ROOMS):
        module = arrow.imported.partition(".")[0]
        if module in {*ROOMS, *sys.stdlib_module_names, "_typeshed"}:
            continue
        names = {canonicalize_name(name) for name in distributions.get(module, [module])}
        if not {PARTS_OF.get(name, name) for name in names} & required:
            missing.add(str(arrow))
    assert not missing, "\n".join(["not in pyproject.toml:", *sorted(missing)])


LOCKS = (
    "requirements.lock",
    "requirements-dev.lock",
    "requirements-node.lock",
    "requirements-audit.lock",
)


@pytest.mark.parametrize("lock", LOCKS)
def test_the_lock_file_serves_pyproject(lock: str) -> None:
    locked = pins(lock)
    stale = [
        str(requirement)
        for requirement in wanted(lock)
        if not locked.get(requirement.name)
        or not all(version in requirement.specifier for version in locked[requirement.name])
    ]
    assert not stale, f"run make lock: {lock} does not serve {stale}"


@pytest.mark.parametrize("lock", LOCKS)
def test_every_pin_has_hashes(lock: str) -> None:
    blocks = re.split(
        r"^(?=[a-z0-9])", (PROJECT / lock).read_text(encoding="utf-8"), flags=re.MULTILINE
    )
    assert len(blocks) > 1
    assert [block for block in blocks[1:] if "--hash=sha256:" not in block] == []


def test_tests_run_against_the_versions_that_people_get() -> None:
    development = pins("requirements-dev.lock")
    differing = {
        name: (versions, development.get(name))
        for name, versions in pins("requirements.lock").items()
        if development.get(name) != versions
    }
    assert not differing
