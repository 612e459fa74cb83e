"""The scenes of the simulated camera's README, and a garage to look at."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import cv2
import numpy as np

import drivers.simulator.camera
from drivers.simulator.camera.conditions import Conditions
from drivers.simulator.camera.imaging import ImagingParameters
from drivers.simulator.parameters import SimulationParameters
from drivers.simulator.view import CameraView, Pose

README = Path(drivers.simulator.camera.__file__).with_name("README.md")
PAYLOAD = "PLUGPILOT:1:7F3K22Q9"
SIZE_MM = 60.0


def scenes() -> dict[str, SimulationParameters]:
    """Every configuration example by its heading, and the defaults first."""
    found = {"Ordinary garage": SimulationParameters()}
    for heading, example in re.findall(
        r"^### (.+?)$[^`]+?```toml\n(.+?)```", README.read_text(), re.MULTILINE | re.DOTALL
    ):
        parameters = tomllib.loads(example)["simulation"]["parameters"]
        found[heading] = SimulationParameters.model_validate(parameters)
    return found


def pose(x: float, y: float, z: float, turn: tuple[float, float, float] = (0, 0, 0)) -> Pose:
    """A pose from a translation [mm] and a rotation vector [rad]."""
    result = np.eye(4)
    result[:3, :3] = cv2.Rodrigues(np.array(turn, dtype=np.float64))[0]
    result[:3, 3] = x, y, z
    return result


def view(
    label: Pose,
    velocity_mm_s: tuple[float, float, float] = (0.0, 0.0, 0.0),
    plug: Pose | None = None,
    socket_mm: tuple[float, float, float] = (120.0, 0.0, 0.0),
) -> CameraView:
    """A car with its socket beside the label; the plug is out of the picture if not given."""
    return CameraView(
        T_camera_label=label,
        T_camera_socket=label @ pose(*socket_mm),
        T_camera_plug=pose(900.0, 0.0, 100.0) if plug is None else plug,
        label_velocity_mm_s=np.array(velocity_mm_s),
        payload=PAYLOAD,
        label_size_mm=SIZE_MM,
    )


def everything() -> tuple[ImagingParameters, Conditions]:
    """All effects at once, as far as they do not hide one another."""
    conditions = Conditions.model_validate(
        {
            "label": {"dirt": 0.03, "covered": 0.02},
            "lamps": {"own": 0.3, "ceiling": 1.0},
            "rain": {"drops_per_dm2": 30.0, "lens_drops": 3},
        }
    )
    return ImagingParameters(automatic_exposure=True), conditions
