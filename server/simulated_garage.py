"""What surrounds a simulated robot: the car before it, and a plant that follows a real board."""

from __future__ import annotations

from drivers.registry import SIMULATOR, Devices
from drivers.simulator.camera.camera import SimulatedCamera
from drivers.simulator.world import SimulatedWorld
from server.config.settings import Settings
from server.control.supervisor import Supervisor
from server.schema.vehicles import SocketOffset, VehicleSettings
from server.simulated_car import SimulatedCar
from server.simulated_hand import SimulatedHand
from server.storage.vehicles import VehicleStore

DEMO_NAME = "Demo car"


async def introduce(world: SimulatedWorld, vehicles: VehicleStore) -> None:
    """Make the simulated car known, as its owner would have measured it, and label it.

    Done at every start: another seed is another car with the same label.
    """
    car = world.car
    offset = car.known_offset
    vehicle, _ = await vehicles.put(
        car.vehicle_id,
        VehicleSettings(
            name=DEMO_NAME,
            label_size_mm=car.label_size_mm,
            socket=SocketOffset(
                x_mm=offset.x_mm,
                y_mm=offset.y_mm,
                z_mm=offset.z_mm,
                rotation_x_rad=offset.rotation_x_rad,
                rotation_y_rad=offset.rotation_y_rad,
            ),
        ),
    )
    world.stick_label(vehicle.label_payload)


def simulated_car(devices: Devices, settings: Settings) -> SimulatedCar | None:
    """The car before a simulated camera."""
    if devices.world is None or settings.camera.driver != SIMULATOR:
        return None
    return SimulatedCar(devices.world)


def simulated_hand(devices: Devices) -> SimulatedHand | None:
    """A hand with the calibration board before a simulated camera."""
    if devices.world is None or not isinstance(devices.camera, SimulatedCamera):
        return None
    return SimulatedHand(devices.camera, devices.world.parameters.imaging)


def let_follow(devices: Devices, supervisor: Supervisor) -> None:
    """Let the simulated surroundings of a real robot know where it stands, if there are any."""
    if devices.followed is None:
        return
    follower = devices.followed.follower

    def pass_on() -> None:
        state = supervisor.board_state
        if state is not None:
            follower.take(state)

    supervisor.listen(pass_on)
