"""What route functions ask for."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends
from fastapi.requests import HTTPConnection

from server.services import Services


async def running_services(connection: HTTPConnection) -> Services:
    """The running parts, as the lifespan of the application left them.

    A coroutine, although it waits for nothing: anything else would cost each request, a stop
    too, its turn in the pool of threads.
    """
    services = connection.app.state.services
    assert isinstance(services, Services)  # noqa: S101 - set by the lifespan
    return services


ServicesDep = Annotated[Services, Depends(running_services)]
