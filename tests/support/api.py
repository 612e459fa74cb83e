"""The web application around a scene, called without a socket, in virtual time."""

from __future__ import annotations

import functools
from collections.abc import Awaitable, Callable, Sequence
from typing import Any, TypeVar

import httpx
from fastapi import FastAPI

from server.access import Scope
from server.api.app import PREFIX, create_app
from server.api.gate.caller import COOKIE
from server.api.openapi import _never_started
from server.config.settings import Settings
from server.schema.problem import TYPE_PREFIX
from server.services import Services
from tests.support.garage import Scene, on_scene
from tests.support.pairing import new_device, new_key

T = TypeVar("T")


@functools.cache
def _application() -> FastAPI:
    return create_app(_never_started)


def application(services: Services) -> FastAPI:
    """The real application, around these services.

    Making it takes a fifth of a second, and it keeps nothing but its services: all tests share it.
    """
    app = _application()
    app.state.services = services
    return app


def on_api(
    scenario: Callable[[Scene, httpx.AsyncClient], Awaitable[T]],
    *,
    seed: int = 4,
    parked: bool = False,
    settings: Settings | None = None,
    scopes: Sequence[Scope] = (),
) -> T:
    """Run a scenario with a client of the API. Paths are relative to /api/v1/.

    The client is the owner's browser, or a program that has a key of some scopes.
    """

    async def with_client(scene: Scene) -> T:
        app = application(scene.services)
        access = scene.services.access
        headers, cookies = {}, {}
        if scopes:
            headers["Authorization"] = f"Bearer {await new_key(access, *scopes)}"
        else:
            cookies[COOKIE] = await new_device(access)
        async with httpx.AsyncClient(
            transport=httpx.ASGITransport(app, raise_app_exceptions=False),
            base_url=f"http://plugpilot{PREFIX}/",
            headers=headers,
            cookies=cookies,
        ) as client:
            return await scenario(scene, client)

    return on_scene(with_client, seed=seed, parked=parked, settings=settings)


def problem(response: httpx.Response, status: int, code: str) -> dict[str, Any]:
    """The problem document of a response, checked for everything that RFC 9457 and we promise."""
    assert response.status_code == status, response.text
    assert response.headers["content-type"] == "application/problem+json"
    document: dict[str, Any] = response.json()
    assert document["status"] == status
    assert document["code"] == code
    assert document["type"] == TYPE_PREFIX + code
    for words in ("title", "detail", "remedy"):
        assert document[words].strip(), f"no {words} in {document}"
    assert "Traceback" not in response.text
    assert "server/" not in response.text
    return document
