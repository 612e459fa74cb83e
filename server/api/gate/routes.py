"""Which operation a request is, and what it needs."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from fastapi.routing import APIRoute, APIWebSocketRoute, RouteContext, iter_route_contexts
from starlette.routing import BaseRoute
from starlette.types import Scope

from server.access import Need

WEBSOCKET = "WEBSOCKET"


@dataclass(frozen=True, slots=True)
class Operation:
    """One operation that the application offers.

    Attributes:
        name: As in `server.access.operations`.
        need: What it needs; None when it does not stand in the table, so that nobody may.
        methods: Methods of HTTP, or "WEBSOCKET".
        pattern: The paths it has.
    """

    name: str
    need: Need | None
    methods: frozenset[str]
    pattern: re.Pattern[str]


class RouteTable:
    """All operations of an application.

    Args:
        routes: Of the application.
        needs: What each operation needs.
    """

    def __init__(self, routes: Sequence[BaseRoute], needs: Mapping[str, Need]) -> None:
        self.operations = [
            Operation(name, needs.get(name), methods, pattern)
            for name, methods, pattern in _operations(routes)
        ]

    def find(self, scope: Scope) -> Operation | None:
        """The operation that a request asks for; None when there is nothing at its address."""
        method = WEBSOCKET if scope["type"] == "websocket" else scope["method"]
        path = scope["path"]
        for operation in self.operations:
            if method in operation.methods and operation.pattern.match(path):
                return operation
        return None

    @property
    def unlisted(self) -> list[str]:
        """Operations that do not stand in the table."""
        return [operation.name for operation in self.operations if operation.need is None]


def _operations(
    routes: Sequence[BaseRoute],
) -> Iterator[tuple[str, frozenset[str], re.Pattern[str]]]:
    for route in iter_route_contexts(routes):
        pattern = route.path_regex
        if isinstance(route.original_route, APIWebSocketRoute):
            yield f"{WEBSOCKET} {route.path}", frozenset({WEBSOCKET}), pattern
            continue
        methods = frozenset(route.methods or ())
        yield _name(route, methods), methods, pattern


def _name(route: RouteContext, methods: frozenset[str]) -> str:
    if isinstance(route.original_route, APIRoute) and route.operation_id:
        return str(route.operation_id)
    return f"{'GET' if 'GET' in methods else '/'.join(sorted(methods))} {route.path}"
