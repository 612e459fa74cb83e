"""Which module of the project imports which, read from the sources without running them."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True, slots=True)
class Arrow:
    """One import.

    Attributes:
        importer: Module that imports, such as "server.jobs.runner".
        imported: Module or name that is imported, such as "twin.geometry.RobotGeometry".
        place: File and line, to be clicked on.
    """

    importer: str
    imported: str
    place: str

    def __str__(self) -> str:
        """As it stands in a list of faults."""
        return f"{self.place}: {self.importer} imports {self.imported}"


def arrows_of(source: str, module: str, place: str) -> Iterator[Arrow]:
    """All imports of one source text, also those inside functions and TYPE_CHECKING."""
    for node in ast.walk(ast.parse(source)):
        where = f"{place}:{getattr(node, 'lineno', 0)}"
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield Arrow(module, alias.name, where)
        elif isinstance(node, ast.ImportFrom):
            if node.level:
                msg = f"{where}: relative import; write the whole name"
                raise ValueError(msg)
            for alias in node.names:
                yield Arrow(module, f"{node.module}.{alias.name}", where)


def modules_in(project: Path, rooms: tuple[str, ...]) -> dict[str, Path]:
    """All modules in some top folders, with their files."""
    return {
        ".".join(file.relative_to(project).with_suffix("").parts).removesuffix(".__init__"): file
        for room in rooms
        for file in sorted((project / room).rglob("*.py"))
    }


def arrows_in(project: Path, rooms: tuple[str, ...]) -> list[Arrow]:
    """All imports in the Python files of some top folders."""
    return [
        arrow
        for module, file in modules_in(project, rooms).items()
        for arrow in arrows_of(
            file.read_text(encoding="utf-8"), module, str(file.relative_to(project))
        )
    ]


def within(module: str, package: str) -> bool:
    """The module is the package or lies inside it."""
    return module == package or module.startswith(f"{package}.")
