"""The arrows of ARCHITECTURE.md: who may import whom."""

from __future__ import annotations

from collections.abc import Iterable
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

from tests.support.imports import Arrow, arrows_in, arrows_of, modules_in, within

PROJECT = Path(__file__).parents[1]
ROOMS = ("server", "drivers", "twin")
OURS = (*ROOMS, "tests", "web")

ALLOWED: dict[str, set[str]] = {
    "twin": {"twin"},
    "drivers": {"drivers", "twin"},
    "server": {"server", "drivers", "twin"},
    # Inside drivers: what is real knows nothing of what is simulated.
    "drivers.robot": {"drivers.robot", "twin"},
    "drivers.camera": {"drivers.camera", "twin"},
    "drivers.station": {"drivers.station", "twin"},
    # Inside server, from the bottom up.
    "server.errors": set(),
    "server.timing": set(),
    "server.config": {"server.config", "server.errors", "drivers", "twin"},
    "server.vision": {"server.vision", "server.errors", "drivers.camera", "twin"},
    "server.control": {
        "server.control",
        "server.errors",
        "server.timing",
        "server.config",
        "drivers.robot",
        "drivers.station",
        "twin",
    },
}
"""The only parts of the project that a package may import."""

WIRING = {
    "server.services",
    "server.diagnostics",
    "server.composition",
    "server.serving",
    "server.simulation",
    "server.simulated_garage",
    "server.simulated_calibration",
    "server.simulated_technician",
    "server.cli",
}
"""What puts the parts together; the parts do not know it."""

FORBIDDEN: dict[str, set[str]] = {
    "server.localisation": {"server.jobs", "server.live", "server.storage", *WIRING},
    "server.access": {
        "server.api",
        "server.control",
        "server.jobs",
        "server.live",
        "drivers",
        *WIRING,
    },
    "server.storage": {
        "server.access",
        "server.localisation",
        "server.live",
        *WIRING,
        "drivers",
        "twin.motion",
    },
    "server.jobs": {"server.live", *WIRING, "drivers.simulator"},
    "server.calibration": {"server.api", "server.live", *WIRING, "drivers.simulator"},
    "server.divergence": {"server.live", "server.api", *WIRING, "drivers.simulator"},
    "server.recordings": {"server.api", *WIRING, "drivers.simulator"},
    "server.events": {"server.api", *WIRING, "drivers.simulator"},
    "server.webhooks": {"server.api", "server.jobs", "server.control", *WIRING, "drivers"},
    "server.charge_point": {"server.api", *WIRING, "drivers.simulator"},
    "server.adjusting": {"server.api", "server.jobs", "server.control", *WIRING, "drivers"},
    "server.technician": {"server.api", *WIRING, "drivers.simulator"},
    "server.live": {"server.api.app", *(WIRING - {"server.services"}), "drivers.simulator"},
    "server.api": {*(WIRING - {"server.services", "server.diagnostics"}), "drivers.simulator"},
    "server.services": {"server.cli", "server.serving", "server.simulation", "server.composition"},
    "server.composition": {"server.cli", "server.serving", "server.simulation"},
    "server.serving": {"server.cli", "server.simulation"},
    "server.simulation": {"server.cli", "server.serving"},
}
"""Parts of the project that a package must not import, where a list of the allowed is long."""


def wrong_arrows(arrows: Iterable[Arrow]) -> list[Arrow]:
    """The imports that break a rule."""
    return [arrow for arrow in arrows if _is_wrong(arrow)]


def _is_wrong(arrow: Arrow) -> bool:
    if not any(within(arrow.imported, room) for room in OURS):
        return False  # a library
    for package, allowed in ALLOWED.items():
        if within(arrow.importer, package) and not any(
            within(arrow.imported, part) for part in allowed
        ):
            return True
    return any(
        within(arrow.importer, package) and within(arrow.imported, part)
        for package, forbidden in FORBIDDEN.items()
        for part in forbidden
    )


def test_every_arrow_points_the_right_way() -> None:
    arrows = arrows_in(PROJECT, ROOMS)
    assert len(arrows) > 100, "the sources were not found"
    wrong = wrong_arrows(arrows)
    assert not wrong, "\n".join(["see ARCHITECTURE.md:", *map(str, wrong)])


def test_no_module_needs_itself() -> None:
    modules = modules_in(PROJECT, ROOMS)
    needs: dict[str, set[str]] = {module: set() for module in modules}
    for arrow in arrows_in(PROJECT, ROOMS):
        # "from a.b import c" needs the module a.b.c where there is one, else a.b
        for candidate in (arrow.imported, arrow.imported.rpartition(".")[0]):
            if candidate in modules:
                needs[arrow.importer].add(candidate)
                break
    try:
        TopologicalSorter(needs).prepare()
    except CycleError as error:
        pytest.fail("a circle of imports: " + " <- ".join(error.args[1]))


@pytest.mark.parametrize(
    ("importer", "statement", "is_wrong"),
    [
        ("twin.scene.robot", "from drivers.robot import RobotState", True),
        ("twin.scene.robot", "import server", True),
        ("twin.scene.robot", "from twin.geometry import RobotGeometry", False),
        ("drivers.simulator.plant", "from server.control.model import Mode", True),
        ("drivers.camera.v4l", "def f():\n    from drivers.simulator import view", True),
        ("server.vision.locator", "from server.jobs.model import Job", True),
        ("server.vision.locator", "from drivers.simulator.view import CameraView", True),
        ("server.control.supervisor", "from server.jobs.errors import JobError", True),
        ("server.jobs.runner", "from server.control.supervisor import Supervisor", False),
        ("server.jobs.runner", "from server.schema.jobs import JobView", False),
        ("server.api.app", "import server.cli", True),
        ("server.api.app", "import tests.support.imports", True),
        ("server.api.app", "import serverless", False),
        ("server.errors", "from server.config import Settings", True),
    ],
)
def test_the_rules_tell_right_from_wrong(importer: str, statement: str, is_wrong: bool) -> None:
    arrows = list(arrows_of(statement, importer, "example.py"))
    assert bool(wrong_arrows(arrows)) is is_wrong


def test_every_rule_speaks_of_something_that_exists() -> None:
    parts = {part for rules in (ALLOWED, FORBIDDEN) for part in set().union(*rules.values())}
    for name in {*ALLOWED, *FORBIDDEN, *parts} - {"tests", "web"}:
        path = PROJECT / name.replace(".", "/")
        assert path.is_dir() or path.with_suffix(".py").is_file(), f"{name} does not exist"
