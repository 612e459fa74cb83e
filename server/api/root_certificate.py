"""The root of the installation's own authority, for phones to install."""

from __future__ import annotations

from fastapi import APIRouter, Response

from server.api.dependencies import ServicesDep
from server.api.errors import NotFoundError
from server.tls import FOLDER, ROOT_FILE

router = APIRouter(include_in_schema=False)


@router.get("/root.crt")
def root_certificate(services: ServicesDep) -> Response:
    """The certificate; it is public."""
    settings = services.settings
    if settings.tls.mode != "own":
        raise NotFoundError("This robot has no certificate authority of its own.")
    file = settings.storage.data_dir / FOLDER / ROOT_FILE
    return Response(
        file.read_bytes(),
        media_type="application/x-x509-ca-cert",
        headers={"Content-Disposition": 'attachment; filename="plugpilot-root.crt"'},
    )
