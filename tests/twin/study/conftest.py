"""Studies that several tests look at; nothing changes them."""

from __future__ import annotations

import pytest

from twin.geometry import RobotGeometry
from twin.study.analyse import study
from twin.study.optimise import Optimum, optimise
from twin.study.report import StudyReport


@pytest.fixture(scope="session")
def default_report() -> StudyReport:
    return study(RobotGeometry())


@pytest.fixture(scope="session")
def smallest() -> Optimum:
    return optimise(RobotGeometry())
