"""How exact and how quick parking guidance is: `python -m tests.bench.guidance [CARS]`.

Cars drive into simulated garages, each seen through its own simulated camera. For each distance of
the label: how far the guided place is from the truth at the picture's time, beside what the four
corners of the code alone give (as common detectors do), how often the truth is inside the stated
95%, and from where the label is read at all. Then the real server: from the middle of a picture's
exposure to the page that shows it.
"""

from __future__ import annotations

import asyncio
import json
import math
import statistics
import sys
import tempfile
import time
from collections.abc import Sequence
from datetime import datetime
from pathlib import Path
from typing import NamedTuple

import cv2
import numpy as np
from websockets.asyncio.client import connect

from drivers.simulator.garage import SimulatedGarage, build_garage
from drivers.simulator.traffic import Arrival, Traffic
from server.config.settings import Settings
from server.guidance.model import Sighting
from server.guidance.sight import Expected, LabelSight
from server.guidance.track import CarTrack
from server.jobs.approach import parking_joints
from server.localisation.frames import Pose, base_from_camera, inverse
from server.localisation.socket_pose import socket_from_label
from server.schema.vehicles import SocketOffset, Vehicle
from server.timing import VirtualTimeLoop
from server.vision import Locator, VisionError
from server.vision.markers.qr_codes import QrCodes
from tests.support.process import serving

CARS = 6
PERIOD_S = 0.1
FROM_MM = 1700.0
LONGEST_S = 22.0
BINS_MM = (300, 400, 600, 900, 1500)
PAYLOAD = "PP2:zoe:4NG43RRFJW"
INSIDE_95 = 5.99  # chi-square, two degrees of freedom


class Look(NamedTuple):
    """One picture: errors of x and z [mm], of both ways, and whether the doubt was honest."""

    distance_mm: float
    moving: bool
    guided: tuple[float, float] | None
    corners: tuple[float, float] | None
    inside: bool
    fit_ms: float


def main() -> None:
    """Measure and print."""
    cv2.setNumThreads(1)
    cars = int(sys.argv[1]) if len(sys.argv) > 1 else CARS
    looks: list[Look] = []
    first_mm = []
    for seed in range(cars):
        with asyncio.Runner(loop_factory=VirtualTimeLoop) as runner:
            seen = runner.run(_drive_in(seed))
        looks += seen
        first_mm.append(max(look.distance_mm for look in seen if look.guided))
    print(f"{cars} cars, {len(looks)} pictures, one every {PERIOD_S:g} s\n")
    print(
        f"first read at {min(first_mm):.0f} to {max(first_mm):.0f} mm from the camera "
        f"(median {statistics.median(first_mm):.0f})\n"
    )
    print("label at mm    read    guided x          z           four corners x     z      in 95%")
    near = 0
    for far in BINS_MM:
        _print_bin([look for look in looks if near <= look.distance_mm < far], near, far)
        near = far
    times = [look.fit_ms for look in looks if look.guided]
    print(f"\none look: median {statistics.median(times):.1f} ms, p95 {_p95(times):.1f} ms")
    latencies = asyncio.run(_latencies())
    print(
        f"picture to page: median {statistics.median(latencies):.0f} ms, "
        f"p95 {_p95(latencies):.0f} ms of {len(latencies)} (45 ms of it read-out and transfer)"
    )


def _print_bin(looks: Sequence[Look], near: int, far: int) -> None:
    guided = [look.guided for look in looks if look.guided]
    corners = [look.corners for look in looks if look.corners]
    if not guided:
        print(f"{near:>5} - {far:<6} {0:>4} of {len(looks)}")
        return
    inside = statistics.mean(look.inside for look in looks if look.guided)
    print(
        f"{near:>5} - {far:<6} {len(guided):>4} of {len(looks):<4} "
        f"{_spread([x for x, _ in guided])} {_spread([z for _, z in guided])}    "
        f"{_spread([x for x, _ in corners])} {_spread([z for _, z in corners])}  {inside:.0%}"
    )


async def _drive_in(seed: int) -> list[Look]:
    settings = Settings()
    garage, T_base_camera = _garage(settings, seed)
    world = garage.world
    vehicle = _vehicle(world.car.label_size_mm, garage)
    sight = LabelSight(settings.camera.optics, settings.geometry)
    rng = np.random.default_rng(seed)
    Traffic(world).arrive(
        Arrival(
            from_mm=FROM_MM,
            right_mm=float(rng.uniform(-40, 40)),
            past_mm=float(rng.uniform(-15, 10)),
        ),
        0.0,
    )
    await garage.camera.open()
    track: CarTrack | None = None
    looks = []
    loop = asyncio.get_running_loop()
    while loop.time() < LONGEST_S:
        due_s = loop.time() + PERIOD_S
        frame = await garage.camera.frame()
        at_s = frame.captured_at_s
        began = time.perf_counter()
        expected = None
        if track is not None:
            T_camera_label = inverse(T_base_camera) @ track.label_at(at_s)
            expected = Expected(vehicle.id, T_camera_label)
        found = sight.look(frame.image, at_s, T_base_camera, [vehicle], expected)
        fit_ms = 1000 * (time.perf_counter() - began)
        guided, inside, truth = None, False, world.spot.at(at_s)
        if isinstance(found, Sighting):
            if track is None:
                track = CarTrack(found, settings.guidance)
            else:
                track.take(found)
            car = track.estimate
            error = (car.place_mm - truth.T_base_socket[:3, 3])[[0, 2]]
            covariance = car.covariance_mm2[np.ix_([0, 2], [0, 2])]
            guided = (float(error[0]), float(error[1]))
            inside = bool(error @ np.linalg.solve(covariance, error) < INSIDE_95)
        view = world.view_at(at_s)
        looks.append(
            Look(
                float(view.T_camera_label[2, 3]),
                bool(np.linalg.norm(view.label_velocity_mm_s) > 5),
                guided,
                _by_corners(frame.image, settings, vehicle, T_base_camera, truth.T_base_socket),
                inside,
                fit_ms,
            )
        )
        await asyncio.sleep(max(0.0, due_s - loop.time()))
    return looks


def _by_corners(
    image: np.ndarray, settings: Settings, vehicle: Vehicle, T_base_camera: Pose, truth: Pose
) -> tuple[float, float] | None:
    codes = QrCodes().find(image, wanted=None) if image.size else []
    if not codes:
        return None
    try:
        pose = Locator(settings.camera.optics).coarse(codes[0], vehicle.label_size_mm)
    except VisionError:
        return None
    socket = socket_from_label(pose, T_base_camera, vehicle.socket, 0.0)
    error = socket.T_base_socket[:3, 3] - truth[:3, 3]
    return float(error[0]), float(error[2])


def _garage(settings: Settings, seed: int) -> tuple[SimulatedGarage, Pose]:
    """A garage whose robot stands parked, and where it takes its camera to be."""
    joints = parking_joints(settings.geometry, settings.park)
    parameters = settings.simulation.parameters
    board = parameters.board.model_copy(update={"start_homed": True, "start_joints": joints})
    garage = build_garage(
        settings.geometry,
        settings.motion,
        settings.camera.mount,
        settings.camera.optics,
        parameters.model_copy(update={"board": board}),
        seed=seed,
    )
    garage.world.stick_label(PAYLOAD)
    return garage, base_from_camera(settings.geometry, settings.camera.mount, joints)


def _vehicle(label_size_mm: float, garage: SimulatedGarage) -> Vehicle:
    known = garage.world.car.known_offset
    return Vehicle(
        id="zoe",
        name="Zoe",
        label_payload=PAYLOAD,
        label_size_mm=label_size_mm,
        socket=SocketOffset(
            x_mm=known.x_mm,
            y_mm=known.y_mm,
            z_mm=known.z_mm,
            rotation_x_rad=known.rotation_x_rad,
            rotation_y_rad=known.rotation_y_rad,
        ),
    )


async def _latencies() -> list[float]:
    """From the middle of an exposure to the message at a watcher [ms]."""
    settings = Settings()
    joints = parking_joints(settings.geometry, settings.park)
    with tempfile.TemporaryDirectory() as folder:
        config = Path(folder) / "plugpilot.toml"
        place = ", ".join(f"{value!r}" for value in joints)
        config.write_text(
            f"[simulation.parameters.board]\nstart_homed = true\nstart_joints = [{place}]\n"
        )
        with serving("--config", str(config), "--seed", "2") as server:
            address = server.url.replace("http", "ws", 1) + "/api/v1/ws"
            async with connect(address, additional_headers=server.headers, proxy=None) as socket:
                order = {"type": "drive_in", "from_mm": 900}
                with server.rest() as client:
                    client.post("simulation/car", json=order).raise_for_status()
                return await _ages_ms(socket)


async def _ages_ms(socket: object) -> list[float]:
    ages, seen = [], ""
    until_s = time.monotonic() + 12.0
    while time.monotonic() < until_s:
        message = json.loads(await asyncio.wait_for(socket.recv(), 10.0))  # type: ignore[attr-defined]
        guidance = (message.get("changes") or {}).get("guidance")
        if guidance is None or guidance["car"] is None or guidance["car"]["seen_at"] == seen:
            continue
        seen = guidance["car"]["seen_at"]
        ages.append(1000 * (time.time() - datetime.fromisoformat(seen).timestamp()))
    return ages


def _spread(errors: Sequence[float]) -> str:
    sizes = [abs(error) for error in errors]
    if not sizes:
        return f"{'-':>11}"
    return f"{statistics.median(sizes):5.2f}/{_p95(sizes):5.2f}"


def _p95(values: Sequence[float]) -> float:
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, math.ceil(0.95 * len(ordered)) - 1)]


if __name__ == "__main__":
    main()
