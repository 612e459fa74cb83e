"""The tables of calibrations: every version that was ever made, and which one counted when."""

from __future__ import annotations

from datetime import datetime
from typing import Any

from sqlalchemy import JSON, Float, ForeignKey, Index, String, UniqueConstraint
from sqlalchemy.orm import Mapped, mapped_column

from server.storage.tables import Base


class CalibrationRow(Base):
    """One version; never changed."""

    __tablename__ = "calibrations"
    __table_args__ = (UniqueConstraint("kind", "subject", "version"),)

    id: Mapped[str] = mapped_column(String(36), primary_key=True)
    kind: Mapped[str] = mapped_column(String(16))
    # Of a vehicle's socket the vehicle; of the robot's own parts "".
    subject: Mapped[str] = mapped_column(String(64))
    version: Mapped[int]
    made_at: Mapped[datetime]
    made_by: Mapped[str] = mapped_column(String(100))
    source: Mapped[str] = mapped_column(String(200))
    grade: Mapped[str] = mapped_column(String(16))
    remarks: Mapped[list[str]] = mapped_column(JSON)
    content: Mapped[dict[str, Any]]
    evidence: Mapped[dict[str, Any] | None] = mapped_column(JSON(none_as_null=True))
    error: Mapped[float | None] = mapped_column(Float)
    error_in_use: Mapped[float | None] = mapped_column(Float)


class CalibrationUseRow(Base):
    """From when a version counts; the newest one that was not undone counts now."""

    __tablename__ = "calibration_uses"
    __table_args__ = (Index("calibration_uses_by_kind", "kind", "subject"),)

    sequence: Mapped[int] = mapped_column(primary_key=True, autoincrement=False)
    kind: Mapped[str] = mapped_column(String(16))
    subject: Mapped[str] = mapped_column(String(64))
    calibration_id: Mapped[str] = mapped_column(ForeignKey("calibrations.id"))
    since: Mapped[datetime]
    by: Mapped[str] = mapped_column(String(100))
    undone_at: Mapped[datetime | None]
    undone_by: Mapped[str | None] = mapped_column(String(100))


class AccuracyCheckRow(Base):
    """A nine-point check."""

    __tablename__ = "accuracy_checks"

    id: Mapped[str] = mapped_column(String(36), primary_key=True)
    made_at: Mapped[datetime]
    content: Mapped[dict[str, Any]]


class CalibrationNoteRow(Base):
    """What calibration remembers between two starts; the newest of each name replaces the last."""

    __tablename__ = "calibration_notes"

    name: Mapped[str] = mapped_column(String(64), primary_key=True)
    written_at: Mapped[datetime]
    content: Mapped[dict[str, Any]]
