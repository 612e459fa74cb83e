"""The light in the garage."""

from __future__ import annotations

from viser import SceneApi


def add_lights(scene: SceneApi) -> None:
    """A key light from the upper left behind the viewer, with shadows, and a cool fill.

    The soft light from all sides is the browser client's built-in surroundings, which cost
    nothing to send.
    """
    scene.configure_default_lights(enabled=False)
    scene.add_light_directional(
        "/lights/key",
        color=(255, 247, 236),
        intensity=2.0,
        cast_shadow=True,
        position=(-1.1, 2.6, -1.3),
    )
    scene.add_light_directional(
        "/lights/fill", color=(206, 224, 255), intensity=0.45, position=(2.2, 1.2, -0.6)
    )
