"""The configuration."""

from __future__ import annotations

from fastapi import APIRouter, Response

from server.adjusting.service import CHANGEABLE
from server.api.dependencies import ServicesDep
from server.api.etags import VERSIONED, IfMatch, etag_of, require_match
from server.api.problems import problem_responses
from server.config.settings import Settings
from server.schema.config import Configuration, ConfigurationPatch

router = APIRouter(prefix="/config", tags=["configuration"])


def _shown(settings: Settings) -> Configuration:
    return Configuration(changeable=list(CHANGEABLE), settings=settings.model_dump(mode="json"))


@router.get("", operation_id="getConfig", summary="Read all settings", responses=VERSIONED)
async def get_config(services: ServicesDep, response: Response) -> Configuration:
    """Everything that can be set, with what is in force. Secrets are hidden."""
    configuration = _shown(services.running_settings.current)
    response.headers["ETag"] = etag_of(configuration)
    return configuration


@router.patch(
    "",
    operation_id="patchConfig",
    summary="Change settings",
    responses={**VERSIONED, **problem_responses(409, 412, 422, 428, 503)},
)
async def patch_config(
    patch: ConfigurationPatch,
    services: ServicesDep,
    response: Response,
    if_match: IfMatch = None,
) -> Configuration:
    """Change settings that need no restart; they are kept, and win over the configuration file."""
    settings = await services.running_settings.change(
        patch, lambda known: require_match(if_match, _shown(known))
    )
    configuration = _shown(settings)
    response.headers["ETag"] = etag_of(configuration)
    return configuration
