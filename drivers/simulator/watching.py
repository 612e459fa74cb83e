"""What the camera has in front of it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from drivers.simulator import poses
from drivers.simulator.car import ParkedCar
from drivers.simulator.plant import Plant, PlantState
from drivers.simulator.view import CameraView, Pose


def plug_pose(plant: Plant, state: PlantState) -> Pose:
    """T_base_plug: origin the centre of the plug's tip, z the insertion axis."""
    return poses.pose(poses.facing_the_car(plant.geometry), np.array(plant.tip(state)))


def camera_view(
    plant: Plant,
    state: PlantState,
    platform_camera: Pose,
    car: ParkedCar,
    label_velocity_mm_s: NDArray[np.float64],
) -> CameraView:
    """The true scene in the camera frame.

    Args:
        plant: The robot as built.
        state: Where it stands.
        platform_camera: T_platform_camera of the camera as it was screwed on.
        car: The car in front of it.
        label_velocity_mm_s: Of its label in the base frame, shape (3,).
    """
    v = plant.platform(state)
    base_platform = poses.pose(np.eye(3), np.array([v.x_mm, v.y_mm, 0.0]))
    camera_base = poses.inverse(base_platform @ platform_camera)
    carriages = state.carriages
    jacobian = plant.mechanism.jacobians_many(np.array(carriages[:2]))
    camera_velocity = np.zeros(3)
    camera_velocity[:2] = jacobian @ np.array(state.velocity[:2])
    return CameraView(
        T_camera_label=camera_base @ car.T_base_label,
        T_camera_socket=camera_base @ car.T_base_socket,
        T_camera_plug=camera_base @ plug_pose(plant, state),
        label_velocity_mm_s=camera_base[:3, :3] @ (label_velocity_mm_s - camera_velocity),
        payload=car.payload,
        label_size_mm=car.label_size_mm,
    )
