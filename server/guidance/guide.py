"""Looks at arriving cars and knows what their drivers should be told.

It never takes the lease and never moves the robot. It looks only while the robot rests in its
parking place and nobody holds it, and only while somebody watches.
"""

from __future__ import annotations

import asyncio
import logging
import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from drivers.camera import CameraDriver, CameraError, Frame
from server.config.settings import Settings
from server.control.supervisor import Supervisor
from server.guidance.advice import Advice, Adviser
from server.guidance.model import CarEstimate, PauseReason, Sighting, Unseen
from server.guidance.parking_place import why_paused
from server.guidance.reach import Reach
from server.guidance.sight import Expected, LabelSight
from server.guidance.track import CarTrack
from server.guidance.vanishing import Vanishing
from server.localisation.frames import Pose, base_from_camera, inverse
from server.localisation.known_camera import KnownCamera
from server.schema.vehicles import Vehicle
from server.storage.vehicles import VehicleStore
from server.vision.errors import VisionError
from twin.joints import JointPosition

_log = logging.getLogger(__name__)

ARRIVES_MM = 80.0
"""A car that has come so far while it was seen is arriving."""

KNOWN_VEHICLES_S = 3.0
"""How old the list of vehicles may be."""


@dataclass(frozen=True, slots=True)
class Guidance:
    """What is known and said now.

    Attributes:
        advice: What the driver is told.
        car: Where the car is; None while none is followed.
        stop_in_mm: How far the place is in front of the socket; None without a car.
        arriving: A car is on its way in, or has just stopped.
        looked_at_s: Middle of the exposure of the newest picture, event loop time; None before it.
    """

    advice: Advice
    car: CarEstimate | None
    stop_in_mm: float | None
    arriving: bool
    looked_at_s: float | None


class Guide:
    """Runs for as long as PlugPilot does.

    Args:
        camera: On the robot.
        supervisor: Says where the robot is and whether it works; it is never commanded.
        vehicles: Whose labels to look for.
        settings: The whole configuration.
        watched: Whether somebody looks at the page.
        speed: Seconds of the event loop per second of the watcher.
    """

    def __init__(
        self,
        camera: CameraDriver,
        supervisor: Supervisor,
        vehicles: VehicleStore,
        settings: Settings,
        *,
        watched: Callable[[], bool],
        speed: float = 1.0,
    ) -> None:
        self.reach = Reach(settings.geometry, settings.insertion, settings.guidance)
        self._camera = camera
        self._supervisor = supervisor
        self._vehicle_store = vehicles
        self._all = settings
        self._settings = settings.guidance
        self._watched = watched
        self._speed = speed
        self.recalibrate(KnownCamera.configured(settings.camera))
        self._adviser = self._new_adviser()
        self._track: CarTrack | None = None
        self._still_since_s: float | None = None
        self._arriving = False
        self._looked_at_s: float | None = None
        self._asked_until_s = -math.inf
        self._known: tuple[float, list[Vehicle]] = (-math.inf, [])
        self._listeners: list[Callable[[], None]] = []
        self._task: asyncio.Task[None] | None = None

    def recalibrate(self, known: KnownCamera) -> None:
        """From now on the camera is like this."""
        self._mount = known.mount
        self._sight = LabelSight(known.optics, self._all.geometry)
        self._vanishing = Vanishing(known.optics, self._all.geometry)

    async def start(self) -> None:
        """Begin to look whenever somebody watches."""
        self._task = asyncio.create_task(self._run(), name="parking guidance")

    async def close(self) -> None:
        """Stop looking."""
        if self._task is not None:
            self._task.cancel()
            await asyncio.wait({self._task})

    def listen(self, listener: Callable[[], None]) -> None:
        """Call ``listener`` after every look, and when guidance pauses."""
        self._listeners.append(listener)

    def ask(self) -> None:
        """Somebody wants to know: keep looking for a while."""
        self._asked_until_s = asyncio.get_running_loop().time() + self._settings.asked_s

    @property
    def now(self) -> Guidance:
        """What is known and said now."""
        car = self._track.estimate if self._track is not None else None
        return Guidance(
            advice=self._adviser.advice,
            car=car,
            stop_in_mm=float(car.place_mm[2]) - self.reach.stop_z_mm if car is not None else None,
            arriving=self._arriving,
            looked_at_s=self._looked_at_s,
        )

    # --- looking -----------------------------------------------------------------------------

    async def _run(self) -> None:
        while True:
            began_s = self._now_s()
            if self._wanted:
                await self._turn()
            elif self._track is not None or self._arriving:
                self._forget()
            period_s = self._period_s
            await asyncio.sleep(max(0.0, began_s + period_s - self._now_s()))

    async def _turn(self) -> None:
        reason = self._why_paused()
        if reason is not None:
            self._pause(reason)
            return
        try:
            frame = await self._camera.frame()
        except CameraError as error:
            _log.debug("no picture for the guidance: %s", error)
            self._pause(PauseReason.CAMERA_DOWN)
            return
        vehicles = await self._vehicles()
        if self._why_paused() is None:  # nobody took the robot meanwhile
            await self._look(frame, vehicles)

    async def _look(self, frame: Frame, vehicles: list[Vehicle]) -> None:
        joints = self._supervisor.telemetry.joints_at(frame.captured_at_s)
        T_base_camera = base_from_camera(self._all.geometry, self._mount, joints)
        self._looked_at_s = frame.captured_at_s
        try:
            found = await asyncio.to_thread(
                self._sight.look,
                frame.image,
                frame.captured_at_s,
                T_base_camera,
                vehicles,
                self._expected(frame.captured_at_s, T_base_camera),
            )
        except VisionError as error:
            _log.warning("the guidance cannot use the camera's pictures: %s", error)
            self._pause(PauseReason.CAMERA_DOWN)
            return
        if isinstance(found, Sighting):
            self._take(found)
        else:
            self._miss(found, T_base_camera, joints)
        self._tell()

    def _expected(self, at_s: float, T_base_camera: Pose) -> Expected | None:
        track = self._track
        if track is None or at_s - track.last.at_s > self._settings.lost_s:
            return None
        T_camera_label = inverse(T_base_camera) @ track.label_at(at_s)
        return Expected(track.last.vehicle_id, T_camera_label)

    def _take(self, sighting: Sighting) -> None:
        track = self._track
        if track is None or sighting.vehicle_id != track.last.vehicle_id:
            track = self._track = CarTrack(sighting, self._settings)
            self._still_since_s = None
        else:
            track.take(sighting)
        car = track.estimate
        self._note_arrival(car, track.travelled_mm)
        self._adviser.advise(car, self._now_s())

    def _note_arrival(self, car: CarEstimate, travelled_mm: float) -> None:
        if not car.still:
            self._still_since_s = None
            self._arriving |= travelled_mm > ARRIVES_MM
            return
        if self._still_since_s is None:
            self._still_since_s = car.at_s
        if car.at_s - self._still_since_s > self._settings.settled_s:
            self._arriving = False

    def _miss(self, why: Unseen, T_base_camera: Pose, joints: JointPosition) -> None:
        """A picture without a place: of a car that was there, or of nothing."""
        now_s, track = self._now_s(), self._track
        if track is not None and now_s - track.last.at_s <= self._settings.lost_s:
            return  # one blurred picture is no news
        if track is not None:
            if now_s - track.last.at_s > self._settings.lost_s + self._settings.gone_s:
                self._track, self._arriving = None, False
            elif why is Unseen.NOTHING:
                if track.estimate.approach_mm_s < 0 and self._was_far(track):
                    self._track, self._arriving = None, False  # it has left
                else:
                    lost_s = self._settings.lost_s
                    way = self._vanishing.direction(track, lost_s, T_base_camera, joints)
                    self._adviser.lose(way, now_s)
                    return
        self._adviser.miss(why, now_s)

    def _was_far(self, track: CarTrack) -> bool:
        """It was last seen where labels cease to be readable anyway."""
        return float(np.linalg.norm(track.last.from_camera_mm)) > 2 * self.reach.stop_z_mm

    # --- when to look ------------------------------------------------------------------------

    @property
    def _wanted(self) -> bool:
        return self._watched() or self._now_s() < self._asked_until_s

    @property
    def _period_s(self) -> float:
        settings, track = self._settings, self._track
        if track is None or not self._wanted:
            return settings.search_period_s * self._speed
        if self._now_s() - track.last.at_s > settings.lost_s:
            return settings.search_period_s * self._speed
        if self._still_since_s is not None:
            return settings.standing_period_s * self._speed
        return settings.tracking_period_s * self._speed

    def _why_paused(self) -> PauseReason | None:
        if not self._settings.enabled:
            return PauseReason.DISABLED
        return why_paused(self._supervisor, self._all.park)

    def _pause(self, reason: PauseReason) -> None:
        if reason is not PauseReason.CAMERA_DOWN:
            self._arriving = False
        self._track, self._still_since_s = None, None
        self._adviser.pause(reason, self._now_s())
        self._tell()

    def _forget(self) -> None:
        """Nobody watched for a while: begin anew next time."""
        self._track, self._still_since_s, self._arriving = None, None, False
        self._adviser = self._new_adviser()

    def _new_adviser(self) -> Adviser:
        limit_rad = math.radians(self._all.insertion.max_tilt_deg)
        return Adviser(self.reach, self._settings, limit_rad, self._now_s())

    async def _vehicles(self) -> list[Vehicle]:
        read_at_s, vehicles = self._known
        if self._now_s() - read_at_s > KNOWN_VEHICLES_S:
            vehicles = await self._vehicle_store.all()
            self._known = (self._now_s(), vehicles)
        return vehicles

    def _tell(self) -> None:
        for listener in self._listeners:
            listener()

    @staticmethod
    def _now_s() -> float:
        return asyncio.get_running_loop().time()
