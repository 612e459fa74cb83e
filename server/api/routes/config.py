"""The configuration."""

from __future__ import annotations

from dataclasses import asdict
from typing import Annotated

from fastapi import APIRouter, Path, Request, Response

from server.adjusting.service import CHANGEABLE, PROTECTING
from server.api.dependencies import ServicesDep
from server.api.etags import VERSIONED, IfMatch, etag_of, require_match
from server.api.gate import caller_of
from server.api.problems import problem_responses
from server.config.fields import setting_fields
from server.config.settings import Settings
from server.schema.config import (
    Configuration,
    ConfigurationCheck,
    ConfigurationDifference,
    ConfigurationField,
    ConfigurationFields,
    ConfigurationHistory,
    ConfigurationPatch,
    ConfigurationTrouble,
    ConfigurationVersion,
)

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
    request: Request,
    services: ServicesDep,
    response: Response,
    if_match: IfMatch = None,
) -> Configuration:
    """Change settings that need no restart; they are kept, and win over the configuration file."""
    settings = await services.running_settings.change(
        patch, lambda known: require_match(if_match, _shown(known)), caller_of(request).label
    )
    configuration = _shown(settings)
    response.headers["ETag"] = etag_of(configuration)
    return configuration


@router.get("/fields", operation_id="getConfigFields", summary="Read what can be set")
async def get_fields() -> ConfigurationFields:
    """Every setting: its kind, what it is for, its limits, and whether it needs a restart."""
    fields = [
        ConfigurationField(
            **{**asdict(each), "choices": list(each.choices)},
            changeable=each.key.partition(".")[0] in CHANGEABLE
            and tuple(each.key.split(".")) not in PROTECTING,
        )
        for each in setting_fields()
    ]
    return ConfigurationFields(fields=fields)


@router.post(
    "/check",
    operation_id="checkConfig",
    summary="Rehearse a change of settings",
)
async def check_config(patch: ConfigurationPatch, services: ServicesDep) -> ConfigurationCheck:
    """What a change would do, or what is wrong with which field. Nothing is changed."""
    found = services.running_settings.rehearse(patch)
    return ConfigurationCheck(
        troubles=[ConfigurationTrouble(**asdict(each)) for each in found.troubles],
        differences=[ConfigurationDifference(**asdict(each)) for each in found.differences],
    )


@router.get(
    "/versions",
    operation_id="listConfigVersions",
    summary="Read earlier settings",
    responses=problem_responses(503),
)
async def list_versions(services: ServicesDep) -> ConfigurationHistory:
    """Who changed what over the API, the newest first; the last one is the start."""
    versions = [
        ConfigurationVersion(**asdict(each)) for each in await services.running_settings.versions()
    ]
    start = ConfigurationVersion(number=0, at=None, by="", changes={})
    return ConfigurationHistory(versions=[*versions, start])


@router.post(
    "/versions/{number}/restore",
    operation_id="restoreConfig",
    summary="Go back to earlier settings",
    responses={**VERSIONED, **problem_responses(404, 409, 412, 422, 428, 503)},
)
async def restore_config(
    number: Annotated[int, Path(ge=0, le=2**53 - 1)],
    request: Request,
    services: ServicesDep,
    response: Response,
    if_match: IfMatch = None,
) -> Configuration:
    """Let everything hold again that held after that change; this is a new version itself."""
    settings = await services.running_settings.restore(
        number, lambda known: require_match(if_match, _shown(known)), caller_of(request).label
    )
    configuration = _shown(settings)
    response.headers["ETag"] = etag_of(configuration)
    return configuration
