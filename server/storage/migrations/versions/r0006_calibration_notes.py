"""What calibration remembers between two starts."""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0006"
down_revision = "0005"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Add a table; nothing that is there changes."""
    op.create_table(
        "calibration_notes",
        sa.Column("name", sa.String(64), primary_key=True),
        sa.Column("written_at", sa.DateTime(), nullable=False),
        sa.Column("content", sa.JSON(), nullable=False),
    )
