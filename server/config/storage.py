"""Where data is kept."""

from __future__ import annotations

from pathlib import Path

from pydantic import Field, SecretStr, field_validator

from server.config.section import Section

SCHEMES = {"postgresql", "postgres", "postgresql+psycopg"}


class StorageSettings(Section):
    """The folder of the database and the recordings, or a database server."""

    data_dir: Path = Field(
        Path("data"),
        description="Made when it is missing; relative to the folder PlugPilot is started in",
    )
    url: SecretStr | None = Field(
        None,
        description="A PostgreSQL server in place of the SQLite file in data_dir, such as "
        "postgresql://user:password@host/name",
    )
    backups_kept: int = Field(
        7,
        ge=0,
        le=365,
        description="Copies of the SQLite file, one a day; 0 makes none",
    )

    @field_validator("url")
    @classmethod
    def _is_for_postgres(cls, url: SecretStr | None) -> SecretStr | None:
        if url is None:
            return None
        # imported late: hardly anybody needs it, and the command line has to be quick
        from sqlalchemy.engine import make_url  # noqa: PLC0415
        from sqlalchemy.exc import ArgumentError  # noqa: PLC0415

        try:
            scheme = make_url(url.get_secret_value()).drivername
        except (ArgumentError, ValueError) as error:
            msg = "must be an address such as postgresql://user:password@host/name"
            raise ValueError(msg) from error
        if scheme not in SCHEMES:
            msg = "must begin with postgresql://; an SQLite file needs no url, see data_dir"
            raise ValueError(msg)
        return url
