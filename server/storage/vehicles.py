"""Keeps vehicles."""

from __future__ import annotations

import asyncio

from sqlalchemy import select
from sqlalchemy.orm import Session

from server.labels.payload import LabelKey, label_text
from server.schema.vehicles import Vehicle, VehicleSettings
from server.storage.database import Database
from server.storage.tables import VehicleRow


class VehicleStore:
    """The vehicles that the robot knows.

    Args:
        database: Where they are kept.
        key: Signs their labels.
    """

    def __init__(self, database: Database, key: LabelKey) -> None:
        self._database = database
        self._key = key
        self.changing = asyncio.Lock()
        """For whoever looks at a vehicle before changing it."""

    async def all(self) -> list[Vehicle]:
        """All vehicles, by name."""

        def work(session: Session) -> list[Vehicle]:
            return [self._vehicle(row) for row in session.scalars(select(VehicleRow))]

        return sorted(await self._database.run(work), key=lambda v: (v.name.casefold(), v.id))

    async def get(self, vehicle_id: str) -> Vehicle | None:
        """One vehicle, or None."""

        def work(session: Session) -> Vehicle | None:
            row = session.get(VehicleRow, vehicle_id)
            return None if row is None else self._vehicle(row)

        return await self._database.run(work)

    async def put(self, vehicle_id: str, settings: VehicleSettings) -> tuple[Vehicle, bool]:
        """Add or change a vehicle; the flag says whether it is new."""

        def work(session: Session) -> tuple[Vehicle, bool]:
            is_new = session.get(VehicleRow, vehicle_id) is None
            row = session.merge(
                VehicleRow(id=vehicle_id, settings=settings.model_dump(mode="json"))
            )
            return self._vehicle(row), is_new

        return await self._database.run(work)

    async def delete(self, vehicle_id: str) -> bool:
        """Forget a vehicle; False when it was not known."""

        def work(session: Session) -> bool:
            row = session.get(VehicleRow, vehicle_id)
            if row is None:
                return False
            session.delete(row)
            return True

        return await self._database.run(work)

    def _vehicle(self, row: VehicleRow) -> Vehicle:
        text = label_text(row.id, self._key)
        return Vehicle(id=row.id, label_payload=text, **row.settings)
