"""The OpenAPI document: the routes plus the messages of the WebSocket."""

from __future__ import annotations

from typing import Any

from fastapi import FastAPI
from pydantic import TypeAdapter

from server.schema.live import ClientMessage, ServerMessage
from server.schema.problem import Problem

REF_TEMPLATE = "#/components/schemas/{model}"


def describe(app: FastAPI) -> None:
    """Add what FastAPI does not see by itself to the application's OpenAPI document."""
    original = app.openapi

    def openapi() -> dict[str, Any]:
        if app.openapi_schema is None:
            document = original()
            schemas = document.setdefault("components", {}).setdefault("schemas", {})
            for name, adapter, mode in (
                ("Problem", TypeAdapter(Problem), "serialization"),
                ("ServerMessage", TypeAdapter(ServerMessage), "serialization"),
                ("ClientMessage", TypeAdapter(ClientMessage), "validation"),
            ):
                schema = adapter.json_schema(ref_template=REF_TEMPLATE, mode=mode)  # type: ignore[arg-type]
                for key, value in schema.pop("$defs", {}).items():
                    schemas.setdefault(key, value)
                schemas[name] = schema
            document["components"]["schemas"] = dict(sorted(schemas.items()))
            app.openapi_schema = document
        return app.openapi_schema

    app.openapi = openapi  # type: ignore[method-assign]
