"""The simulated camera: renders what a real one would see, when a real one would see it."""

from drivers.simulator.camera.camera import SimulatedCamera
from drivers.simulator.camera.imaging import CameraFault, ImagingParameters

__all__ = ["CameraFault", "ImagingParameters", "SimulatedCamera"]
