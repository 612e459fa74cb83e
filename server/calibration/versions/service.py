"""Keeps versions, puts them in force and takes them back."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from functools import partial
from typing import Protocol

from pydantic import TypeAdapter
from uuid6 import uuid7

from server.calibration.grade import Grade
from server.calibration.versions.comparing import Comparison, compared_on_looks
from server.calibration.versions.errors import (
    CalibrationMisfitError,
    CalibrationNotFoundError,
    CalibrationWorseError,
    NothingToRollBackError,
)
from server.calibration.versions.evidence import as_kept, camera_evidence_of, robot_evidence_of
from server.calibration.versions.new_calibration import NewCalibration
from server.calibration.versions.values import ValuesInForce, subject_of
from server.config.settings import Settings
from server.control.built_robot import BuiltRobot
from server.control.finishing import finish
from server.control.lease import Lease
from server.control.supervisor import Supervisor
from server.localisation.known_camera import KnownCamera
from server.schema.calibrations import (
    Calibration,
    CalibrationDetail,
    CalibrationKind,
    CalibrationValues,
    CameraValues,
    RobotEvidence,
    RobotValues,
)
from server.schema.vehicles import Vehicle
from server.storage.calibrations import WHOLE_ROBOT, CalibrationStore, StoredCalibration
from server.storage.database import Database
from server.timing import Calendar

HOLDER = "Calibration"

_VALUES: TypeAdapter[CalibrationValues] = TypeAdapter(CalibrationValues)

Key = tuple[CalibrationKind, str]
"""Kind and subject: of each one version counts."""


class LooksThroughCamera(Protocol):
    """Uses the camera's optics and its place on the robot."""

    def recalibrate(self, known: KnownCamera) -> None:
        """From now on the camera is like this."""


class Calibrations:
    """All versions, and the parts that those in force apply to.

    Args:
        database: Where they are kept.
        settings: What counts where no version is in force.
        calendar: Dates.
    """

    def __init__(self, database: Database, settings: Settings, calendar: Calendar) -> None:
        self._store = CalibrationStore(database)
        self._settings = settings
        self._calendar = calendar
        self._in_force: dict[Key, StoredCalibration] = {}
        self._supervisor: Supervisor | None = None
        self._onlookers: tuple[LooksThroughCamera, ...] = ()
        self._changing = asyncio.Lock()
        self._listeners: list[Callable[[], None]] = []

    @property
    def in_force(self) -> ValuesInForce:
        """The numbers that count now."""
        return _values_of(self._in_force)

    @property
    def versions_in_force(self) -> list[Calibration]:
        """The versions that count now; what is missing is as configured."""
        return [self._shown(stored) for stored in self._in_force.values()]

    @property
    def robot_in_force(self) -> str | None:
        """Id of the calibration of the robot that counts; None: as drawn."""
        stored = self._in_force.get((CalibrationKind.ROBOT, WHOLE_ROBOT))
        return stored.id if stored else None

    @property
    def robot_error_mm(self) -> float | None:
        """What the calibration of the robot that counts missed on looks held back."""
        stored = self._in_force.get((CalibrationKind.ROBOT, WHOLE_ROBOT))
        return stored.error if stored else None

    @property
    def robot_evidence(self) -> RobotEvidence | None:
        """What the calibration of the robot that counts rests on; None: nothing, or as drawn."""
        stored = self._in_force.get((CalibrationKind.ROBOT, WHOLE_ROBOT))
        return robot_evidence_of(stored) if stored else None

    def as_taught(self, vehicle: Vehicle) -> Vehicle:
        """A vehicle with its socket where it was taught, if it was."""
        return self.in_force.as_taught(vehicle)

    def listen(self, listener: Callable[[], None]) -> None:
        """Call ``listener`` when another version is in force."""
        self._listeners.append(listener)

    async def start(self) -> None:
        """Read which versions count."""
        stored = await self._store.in_force()
        self._in_force = {_key(one): one for one in stored}

    def apply_to(self, supervisor: Supervisor, *onlookers: LooksThroughCamera) -> None:
        """From now on, what is in force is applied to these.

        Args:
            supervisor: Made with the mechanism that is in force.
            onlookers: Are told at once how the camera is, and again at each change.
        """
        self._supervisor, self._onlookers = supervisor, onlookers
        self._tell_onlookers(self.in_force)

    async def keep(self, new: NewCalibration) -> Calibration:
        """Keep a new version. It is not in force.

        Raises:
            CalibrationMisfitError: it belongs to another camera mode.
        """
        self._require_fit(new.values)
        kept = await self._store.add(
            StoredCalibration(
                id=str(uuid7()),
                kind=new.values.kind,
                subject=subject_of(new.values),
                made_at=self._calendar.now(),
                made_by=new.made_by,
                source=new.source,
                grade=new.grade.value,
                remarks=list(new.remarks),
                content=new.values.model_dump(mode="json"),
                evidence=as_kept(new.evidence),
                error=new.error,
                error_in_use=new.error_in_use,
            )
        )
        return self._shown(kept)

    async def page(
        self, *, kind: CalibrationKind | None, before: str | None, limit: int
    ) -> list[Calibration]:
        """Versions, newest first; one more than the limit where there are more."""
        found = await self._store.page(kind=kind, before=before, limit=limit)
        return [self._shown(one) for one in found]

    async def get(self, calibration_id: str) -> CalibrationDetail:
        """One version with what it rests on.

        Raises:
            CalibrationNotFoundError: there is none.
        """
        stored = await self._require(calibration_id)
        shown = self._shown(stored)
        return CalibrationDetail(
            **dict(shown),
            evidence=robot_evidence_of(stored),
            camera_evidence=camera_evidence_of(stored),
        )

    async def compare(self, calibration_id: str) -> Comparison:
        """Compare a version with the one in force.

        Raises:
            CalibrationNotFoundError: there is none.
        """
        return self._compared(await self._require(calibration_id))

    async def activate(self, calibration_id: str, *, by: str, accept_worse: bool) -> Calibration:
        """Put a version in force. Nothing moves by it.

        Raises:
            CalibrationNotFoundError: there is none.
            CalibrationWorseError: it is worse, and nobody has said that this is wanted.
            CalibrationMisfitError: it belongs to another camera mode.
            ControlBusyError: a job, or somebody else, uses the robot.
            CalibrationHeldError: the plug is, or may be, in a socket.
            CalibrationUnusableError: no robot like the drawn one is built like that.
        """
        async with self._changing:
            stored = await self._require(calibration_id)
            self._require_fit(_VALUES.validate_python(stored.content))
            if self._counts(stored):
                return self._shown(stored)
            comparison = self._compared(stored)
            if comparison.warning is not None and not accept_worse:
                raise CalibrationWorseError(comparison.warning, **_figures(comparison))
            wanted = {**self._in_force, _key(stored): stored}
            use = partial(self._store.use, stored, self._calendar.now(), by)
            await finish(self._change(wanted, use))
        self._tell()
        return self._shown(stored)

    async def roll_back(
        self, kind: CalibrationKind, *, by: str, subject: str = WHOLE_ROBOT
    ) -> Calibration | None:
        """Go back to what was in force before; None: what is configured.

        Raises:
            NothingToRollBackError: what is configured is in force already.
            ControlBusyError, CalibrationHeldError: as in ``activate``.
        """
        async with self._changing:
            key = (kind, subject)
            if key not in self._in_force:
                raise NothingToRollBackError(f"No calibration of the {kind.value} is in force.")
            before = await self._store.before(kind, subject)
            wanted = {one: stored for one, stored in self._in_force.items() if one != key}
            if before is not None:
                wanted[key] = before
            undo = partial(self._store.undo, kind, self._calendar.now(), by, subject)
            await finish(self._change(wanted, undo))
        self._tell()
        return None if before is None else self._shown(before)

    # Inside

    async def _change(
        self, wanted: dict[Key, StoredCalibration], write: Callable[[], Awaitable[None]]
    ) -> None:
        """Change the parts and what is kept, both or none."""
        if self._supervisor is None:
            raise AssertionError("calibrations were changed before there was a robot")
        async with self._supervisor.control("calibration", HOLDER) as lease:
            self._apply(lease, wanted)
            try:
                await write()
            except BaseException:
                self._apply(lease, self._in_force)
                raise
            self._in_force = wanted

    def _apply(self, lease: Lease, versions: dict[Key, StoredCalibration]) -> None:
        if self._supervisor is None:
            return
        values = _values_of(versions)
        geometry = self._supervisor.geometry
        built = BuiltRobot.of(geometry, values.mechanism, values.force_scale)
        self._supervisor.use_built(lease, built)
        self._tell_onlookers(values)

    def _tell_onlookers(self, values: ValuesInForce) -> None:
        known = values.known_camera(self._settings.camera)
        for onlooker in self._onlookers:
            onlooker.recalibrate(known)

    def _compared(self, stored: StoredCalibration) -> Comparison:
        values, evidence = _VALUES.validate_python(stored.content), robot_evidence_of(stored)
        if isinstance(values, RobotValues) and evidence is not None and evidence.looks:
            return compared_on_looks(
                values, evidence, stored.error, self.in_force.mechanism, self._settings.geometry
            )
        kind = CalibrationKind(stored.kind)
        now = self._in_force.get(_key(stored))
        if isinstance(values, CameraValues) and now is not None:
            return Comparison(kind, stored.error, now.error)
        return Comparison(kind, stored.error, stored.error_in_use)

    def _require_fit(self, values: CalibrationValues) -> None:
        wanted = self._settings.camera.optics
        if not isinstance(values, CameraValues):
            return
        size, expected = ((camera.width, camera.height) for camera in (values.camera, wanted))
        if size != expected:
            raise CalibrationMisfitError(
                f"It was made with pictures of {size[0]} x {size[1]} pixels; the robot takes "
                f"{expected[0]} x {expected[1]}."
            )

    async def _require(self, calibration_id: str) -> StoredCalibration:
        stored = await self._store.get(calibration_id)
        if stored is None:
            raise CalibrationNotFoundError(f"There is no calibration {calibration_id}.")
        return stored

    def _counts(self, stored: StoredCalibration) -> bool:
        now = self._in_force.get(_key(stored))
        return now is not None and now.id == stored.id

    def _shown(self, stored: StoredCalibration) -> Calibration:
        return Calibration(
            id=stored.id,
            kind=CalibrationKind(stored.kind),
            version=stored.version,
            values=_VALUES.validate_python(stored.content),
            grade=Grade(stored.grade),
            remarks=stored.remarks,
            error=stored.error,
            error_in_use=stored.error_in_use,
            made_at=stored.made_at,
            made_by=stored.made_by,
            source=stored.source,
            in_force=self._counts(stored),
        )

    def _tell(self) -> None:
        for listener in self._listeners:
            listener()


def _values_of(versions: dict[Key, StoredCalibration]) -> ValuesInForce:
    return ValuesInForce.of(_VALUES.validate_python(one.content) for one in versions.values())


def _key(stored: StoredCalibration) -> Key:
    return CalibrationKind(stored.kind), stored.subject


def _figures(comparison: Comparison) -> dict[str, float | None]:
    unit = comparison.kind.unit.lower()
    return {f"error_{unit}": comparison.candidate, f"in_force_{unit}": comparison.in_force}
