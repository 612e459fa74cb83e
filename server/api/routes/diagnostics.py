"""Versions, and the diagnostics bundle."""

from __future__ import annotations

from fastapi import APIRouter, Response

from server.api.dependencies import ServicesDep
from server.api.problems import problem_responses
from server.diagnostics import make_bundle
from server.schema.versions import Versions
from server.technician.versions import versions

router = APIRouter(tags=["service"])

_ZIP = "application/zip"
_BUNDLE = {
    "description": "A zip file",
    "content": {_ZIP: {"schema": {"type": "string", "format": "binary"}}},
}


@router.get("/versions", operation_id="getVersions", summary="Read what runs here")
async def get_versions(services: ServicesDep) -> Versions:
    """Software, libraries, firmware, protocol."""
    return versions(services.supervisor.identity)


@router.get(
    "/diagnostics.zip",
    operation_id="getDiagnostics",
    summary="Download the diagnostics",
    response_class=Response,
    responses={200: _BUNDLE, **problem_responses(503)},
)
async def get_diagnostics(services: ServicesDep) -> Response:
    """One file with state, settings, versions, log, audit trail, jobs and the link; no secrets."""
    name = f"plugpilot-diagnostics-{services.calendar.now():%Y%m%d-%H%M%S}.zip"
    return Response(
        await make_bundle(services),
        media_type=_ZIP,
        headers={
            "Content-Disposition": f'attachment; filename="{name}"',
            "Cache-Control": "private, no-store",
        },
    )
