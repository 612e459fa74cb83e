"""Whence the robot's routine knows its belts: from what is typed in, else from what is in force."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, cast

import pytest

from server.calibration.robot.known_before import KnownBefore
from server.calibration.routines.robot_routine import RobotRoutine
from server.calibration.routines.stand import Stand
from server.calibration.versions.values import ValuesInForce
from server.config.settings import Settings
from server.localisation.eye import Eye
from server.schema.calibrations import Provenance, RobotEvidence, RobotValues
from server.schema.routines import BeltReading, RobotRoutineRequest
from server.schema.vehicles import Vehicle
from twin.as_built import PlanarAsBuilt
from twin.geometry import RobotGeometry

NOTHING = cast("Any", None)
SIZED = cast("Vehicle", type("Sized", (), {"label_size_mm": 60.0}))
TYPED = BeltReading(commanded_mm=400.0, measured_mm=402.0, reading_sigma_mm=0.1)
OPEN = KnownBefore().scale_sigma


def known(
    request: RobotRoutineRequest, sigma: float | None, provenance: Provenance = "routine"
) -> KnownBefore:
    """What a robot routine takes for known, with belts of 0.997 and 1.002 in force."""
    values, evidence = None, None
    if sigma is not None:
        drawn = PlanarAsBuilt.as_drawn(RobotGeometry())
        built = drawn.model_copy(update={"left_scale": 0.997, "right_scale": 1.002})
        values = RobotValues(mechanism=built, camera_rotation_rad=(0.0, 0.0, 0.0))
        sigmas = {"left_scale": sigma, "right_scale": sigma}
        evidence = RobotEvidence(
            looks=[], sigma=sigmas, unseen=[], duration_s=0.0, provenance=provenance
        )
    in_force = ValuesInForce(robot=values)
    settings = Settings()
    eye = cast("Eye", SimpleNamespace(optics=settings.camera.optics))
    stand = Stand(
        NOTHING, NOTHING, eye, None, settings, NOTHING, in_force, evidence, NOTHING, NOTHING
    )
    return RobotRoutine(request, "Anna", SIZED)._known(stand)


@pytest.mark.parametrize(
    ("request_", "sigma", "provenance", "scales", "scale_sigma"),
    [
        (RobotRoutineRequest(), None, "routine", (1.0, 1.0), OPEN),
        (RobotRoutineRequest(), 4e-4, "routine", (0.997, 1.002), 4e-4),
        (RobotRoutineRequest(), 3e-3, "routine", (1.0, 1.0), OPEN),
        (RobotRoutineRequest(), 4e-4, "drift", (1.0, 1.0), OPEN),
        (RobotRoutineRequest(left_belt=TYPED), 5e-4, "routine", (1.005, 1.002), 5e-4),
        (RobotRoutineRequest(left_belt=TYPED), None, "routine", (1.005, 1.0), OPEN),
    ],
)
def test_belts_come_from_a_rule_typed_in_now_or_before(
    request_: RobotRoutineRequest,
    sigma: float | None,
    provenance: Provenance,
    scales: tuple[float, float],
    scale_sigma: float,
) -> None:
    found = known(request_, sigma, provenance)
    assert found.scales == pytest.approx(scales)
    assert found.scale_sigma == pytest.approx(scale_sigma)
    assert found.lens_sigma_rad == 3e-3, "nobody has shown it the board"
