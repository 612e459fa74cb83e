"""Finding the label before anything is known of how the robot is built."""

from __future__ import annotations

from collections.abc import Awaitable, Callable

import numpy as np
import pytest

from server.calibration.routines import stand as module
from server.calibration.routines.errors import LabelLostError
from server.calibration.routines.stand import Stand
from server.control.lease import Lease
from tests.server.calibration.routines.test_robot_routine import badly_built
from tests.support.garage import Scene, on_scene, shift_car
from twin.joints import TipPosition
from twin.kinematics import gamma


async def standing(scene: Scene, lease: Lease) -> Stand:
    async def remember(_: object) -> None:
        raise AssertionError("a search has nothing to keep")

    services = scene.services
    return Stand(
        supervisor=services.supervisor,
        lease=lease,
        eye=services.runner._eye,
        owner=await services.vehicles.get(scene.garage.world.car.vehicle_id),
        settings=services.settings,
        as_taught=services.calibrations.as_taught,
        in_force=services.calibrations.in_force,
        evidence=None,
        board=services.routines.board,
        remember=remember,
    )


def on_stand(seed: int, scenario: Callable[[Scene, Stand], Awaitable[None]]) -> None:
    """A scenario before a robot of which only the drawing is known."""

    async def in_control(scene: Scene) -> None:
        async with scene.services.supervisor.control("calibration", "Anna") as lease:
            await scenario(scene, await standing(scene, lease))

    on_scene(in_control, seed=seed, settings=badly_built(play_mm=0.3))


def park_at(scene: Scene, right: float, up: float) -> None:
    """From -1 to 1: from one edge of the regular box to the other."""
    geometry = scene.services.settings.geometry
    box, car = geometry.regular_box, scene.garage.world.car
    now, _ = gamma.platform_for_tip(geometry, TipPosition(*car.T_base_socket[:3, 3].tolist()))
    shift_car(
        scene.garage,
        x_mm=box.center_x_mm + 0.5 * right * box.width_mm - now.x_mm,
        y_mm=box.center_y_mm + 0.5 * up * box.height_mm - now.y_mm,
    )


@pytest.fixture(autouse=True)
def one_picture(monkeypatch: pytest.MonkeyPatch) -> None:
    """A label that one picture shows is found."""
    monkeypatch.setattr(module, "FRAMES", 1)


@pytest.mark.parametrize(
    ("seed", "right", "up"),
    [(27, 0.95, -0.5), (18, -1.0, -1.0), (10, -1.0, 1.0), (16, 1.0, 1.0)],
    ids=["camera turned away", "lower left", "upper left", "upper right"],
)
def test_a_badly_built_robot_finds_the_label_at_the_edge_of_its_box(
    seed: int, right: float, up: float
) -> None:
    async def scenario(scene: Scene, stand: Stand) -> None:
        park_at(scene, right, up)
        found = await stand.find_label()
        aside_mm = np.linalg.norm(found.label_mm[:2])
        centred = await stand.centre_label(found)
        assert np.linalg.norm(centred.label_mm[:2]) < aside_mm, "as near to the middle as it gets"

    on_stand(seed, scenario)


def test_a_label_that_is_nowhere_is_lost_after_all_pictures() -> None:
    async def scenario(scene: Scene, stand: Stand) -> None:
        scene.garage.world.hide_label()
        with pytest.raises(LabelLostError, match="in none of") as caught:
            await stand.find_label()
        assert caught.value.context["looks"] > 9

    on_stand(3, scenario)
