"""The machine as it was really built, drawn around its drawing."""

from __future__ import annotations

import numpy as np

from drivers.camera.model import CameraModel
from drivers.simulator import poses
from drivers.simulator.parameters import BuildErrors, SimulationParameters
from drivers.simulator.plant import Plant
from drivers.simulator.sag import RobotSag
from drivers.simulator.view import Pose
from twin.as_built import PlanarAsBuilt
from twin.camera_mount import CameraMount
from twin.geometry import RobotGeometry
from twin.statics import SagTables

_LENGTHS = (
    "leg_length_mm",
    "base_width_mm",
    "platform_width_mm",
    "e1x_mm",
    "e1y_mm",
    "e2x_mm",
    "e2y_mm",
    "e3y_mm",
    "e3z_mm",
)


def built_geometry(
    nominal: RobotGeometry, errors: BuildErrors, rng: np.random.Generator
) -> RobotGeometry:
    """Geometry with independent errors on every length and on theta."""
    values = {
        name: getattr(nominal, name) + float(rng.normal(0.0, errors.length_std_mm))
        for name in _LENGTHS
    }
    values["theta_rad"] = nominal.theta_rad + float(rng.normal(0.0, errors.theta_std_rad))
    return RobotGeometry.model_validate({**dict(nominal), **values})


def built_mechanism(
    geometry: RobotGeometry, errors: BuildErrors, rng: np.random.Generator
) -> PlanarAsBuilt:
    """Rails and belts of a robot with that true geometry."""
    left_rad, right_rad = rng.normal(0.0, errors.rail_skew_std_rad, 2).tolist()
    left, right = rng.normal(1.0, errors.belt_scale_std, 2).tolist()
    return PlanarAsBuilt.as_drawn(geometry).model_copy(
        update={
            "left_rail_rad": left_rad,
            "right_rail_rad": right_rad,
            "left_scale": left,
            "right_scale": right,
        }
    )


def built_plant(
    geometry: RobotGeometry,
    parameters: SimulationParameters,
    sag: SagTables,
    rng: np.random.Generator,
) -> Plant:
    """The moving parts of a robot with that true geometry."""
    mechanism = built_mechanism(geometry, parameters.build, rng)
    return Plant(
        geometry, mechanism, parameters, RobotSag(geometry, parameters.build.sag_scale, sag)
    )


def built_mount(nominal: CameraMount, errors: BuildErrors, rng: np.random.Generator) -> Pose:
    """T_platform_camera of the camera as it was screwed on, shape (4, 4)."""
    turn = [float(angle) for angle in rng.normal(0.0, errors.mount_angle_std_rad, 3)]
    built = nominal.T_platform_camera
    rotation = poses.rotation_z(turn[2]) @ poses.rotation_y(turn[1]) @ poses.rotation_x(turn[0])
    built[:3, :3] = built[:3, :3] @ rotation
    built[:3, 3] += rng.normal(0.0, errors.mount_offset_std_mm, 3)
    return built


def built_optics(
    nominal: CameraModel, errors: BuildErrors, rng: np.random.Generator
) -> CameraModel:
    """Lens and sensor as they left the factory: another focal length and principal point."""
    focal = 1.0 + float(rng.normal(0.0, errors.focal_std_fraction))
    shift_px = rng.normal(0.0, errors.principal_point_std_px, 2)
    return nominal.model_copy(
        update={
            "fx": nominal.fx * focal,
            "fy": nominal.fy * focal,
            "cx": nominal.cx + float(shift_px[0]),
            "cy": nominal.cy + float(shift_px[1]),
        }
    )
