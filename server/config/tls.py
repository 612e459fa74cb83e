"""Encryption between browsers and the server."""

from __future__ import annotations

from pathlib import Path
from typing import Literal, Self

from pydantic import Field, model_validator

from server.config.section import Section


class TlsSettings(Section):
    """https, with a certificate of one's own authority or with given files."""

    mode: Literal["off", "own", "files"] = Field(
        "off",
        description="off: plain http. own: https with a certificate of this installation's own "
        "authority, whose root every phone installs once. files: https with given files",
    )
    certificate: Path | None = Field(
        None, description="With files: the certificate and its chain, PEM"
    )
    key: Path | None = Field(
        None, description="With files: the private key, PEM, readable by nobody else"
    )

    @model_validator(mode="after")
    def _files_are_named(self) -> Self:
        if self.mode == "files" and (self.certificate is None or self.key is None):
            msg = 'tls.mode "files" needs tls.certificate and tls.key'
            raise ValueError(msg)
        return self
