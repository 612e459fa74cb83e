"""The robot, its garage and the car as a live 3D picture in the browser.

Importing this package is cheap: the 3D library is only loaded when a `TwinHost` starts.
"""

from twin.scene.cable import Cable
from twin.scene.host import TwinHost
from twin.scene.state import PlannedPath, PlugPlace, TwinState

__all__ = ["Cable", "PlannedPath", "PlugPlace", "TwinHost", "TwinState"]
