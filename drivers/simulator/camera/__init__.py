"""The simulated camera: renders what a real one would see, when a real one would see it."""

from drivers.simulator.camera.camera import SimulatedCamera
from drivers.simulator.camera.imaging import CameraFault, ImagingParameters
from drivers.simulator.camera.optics import default_optics

__all__ = ["CameraFault", "ImagingParameters", "SimulatedCamera", "default_optics"]
