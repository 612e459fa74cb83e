"""Schedules, pauses, questions to a person; webhooks, the charge point; numbers of plug records."""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0002"
down_revision = "0001"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Add columns and tables; nothing that is there changes."""
    op.add_column("jobs", sa.Column("not_before", sa.DateTime()))
    op.add_column("jobs", sa.Column("unplug_by", sa.DateTime()))
    op.add_column(
        "jobs", sa.Column("paused", sa.Boolean(), server_default=sa.false(), nullable=False)
    )
    op.add_column("jobs", sa.Column("needs_person", sa.JSON()))
    op.add_column("plug", sa.Column("revision", sa.Integer(), server_default="0", nullable=False))
    _webhooks()
    op.create_table(
        "charge_point",
        sa.Column("id", sa.Integer(), primary_key=True, autoincrement=False),
        sa.Column("enabled", sa.Boolean(), nullable=False),
        sa.Column("resting", sa.String(16)),
        sa.Column("failures", sa.Integer(), nullable=False),
        sa.Column("max_current_a", sa.Float()),
        sa.Column("job_id", sa.String(36)),
        sa.Column("energy_wh", sa.Float(), nullable=False),
        sa.Column("session_wh", sa.Float(), nullable=False),
    )
    op.create_table(
        "changed_settings",
        sa.Column("id", sa.Integer(), primary_key=True, autoincrement=False),
        sa.Column("values", sa.JSON(), nullable=False),
    )


def _webhooks() -> None:
    op.create_table(
        "webhooks",
        sa.Column("id", sa.String(36), primary_key=True),
        sa.Column("url", sa.String(2000), nullable=False),
        sa.Column("description", sa.String(200), nullable=False),
        sa.Column("events", sa.JSON(), nullable=False),
        sa.Column("enabled", sa.Boolean(), nullable=False),
        sa.Column("disabled_reason", sa.String(300)),
        sa.Column("secret", sa.String(100), nullable=False),
        sa.Column("created_at", sa.DateTime(), nullable=False),
        sa.Column("version", sa.Integer(), nullable=False),
    )
    op.create_table(
        "webhook_deliveries",
        sa.Column("id", sa.String(36), primary_key=True),
        sa.Column(
            "webhook_id",
            sa.String(36),
            sa.ForeignKey("webhooks.id", ondelete="CASCADE"),
            nullable=False,
        ),
        sa.Column("event_id", sa.String(36), nullable=False),
        sa.Column("event_type", sa.String(40), nullable=False),
        sa.Column("body", sa.Text(), nullable=False),
        sa.Column("state", sa.String(16), nullable=False),
        sa.Column("created_at", sa.DateTime(), nullable=False),
        sa.Column("next_at", sa.DateTime()),
        sa.Column("attempts", sa.JSON(), nullable=False),
    )
    op.create_index(
        "deliveries_by_webhook", "webhook_deliveries", ["webhook_id", "state", "next_at"]
    )
