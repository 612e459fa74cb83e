"""All tables together: who compares or copies a whole database takes ``Base`` from here."""

from server.storage import (
    access_tables,
    calibration_tables,
    integration_tables,
    push_tables,
    tables,
)
from server.storage.tables import Base

MODULES = (tables, integration_tables, access_tables, calibration_tables, push_tables)
"""Where tables are defined; a new module has to stand here."""

__all__ = ["MODULES", "Base"]
