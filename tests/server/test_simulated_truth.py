"""What campaigns measure by is where the simulated robot really comes to rest."""

from __future__ import annotations

import numpy as np

from drivers.simulator.truth import mechanism_from_below, tip_from_below
from server.config.settings import Settings
from tests.support.garage import Scene, on_scene
from twin.joints import JointPosition

PLAY_MM = (0.3, 0.2, 0.1)
STEP_MM = 1.0


def with_play() -> Settings:
    settings = Settings()
    parameters = settings.simulation.parameters
    drives = parameters.drives.model_copy(update={"backlash_mm": PLAY_MM})
    parameters = parameters.model_copy(update={"drives": drives})
    simulation = settings.simulation.model_copy(update={"parameters": parameters})
    return settings.model_copy(update={"simulation": simulation})


def test_the_tip_is_where_it_is_said_to_come_to_rest_from_below() -> None:
    async def scenario(scene: Scene) -> None:
        world, supervisor = scene.garage.world, scene.services.supervisor
        sent = JointPosition(200.0, 180.0, 60.0)
        async with supervisor.control("jog", "Anna") as lease:
            await supervisor.move_joints(lease, JointPosition(*(q - STEP_MM for q in sent)))
            await supervisor.move_joints(lease, sent)
        assert await scene.still()
        zero = world.surroundings.zero
        said = tip_from_below(world.plant, sent, zero, PLAY_MM)
        np.testing.assert_allclose(scene.truth().T_base_plug[:3, 3], said, atol=0.02)
        built = mechanism_from_below(world.plant, zero, PLAY_MM).forward(200.0, 180.0)
        carriages = world.advance(scene.now_s).carriages
        really = world.plant.mechanism.forward(carriages.rho1_mm, carriages.rho2_mm)
        np.testing.assert_allclose(built, really, atol=0.02)

    on_scene(scenario, seed=3, settings=with_play())
