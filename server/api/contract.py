"""The OpenAPI document: the routes, the messages of the WebSocket, the webhooks, and examples."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from fastapi import FastAPI
from pydantic import TypeAdapter

from server.access import OPERATIONS, Need
from server.access.operations import COMMANDS
from server.api.examples import BODIES, MODELS, REQUESTS
from server.api.gate.caller import COOKIE
from server.api.problem_examples import problem_example
from server.api.problems import MEDIA_TYPE, problem_responses
from server.schema.events import Event
from server.schema.live import ClientMessage, ServerMessage
from server.schema.problem import Problem

REF_TEMPLATE = "#/components/schemas/{model}"
Document = dict[str, Any]
STOPS = {"stopRobot", "emergencyStopRobot"}
"""Never refused, whatever comes with them."""

SECURITY_SCHEMES: Document = {
    "session": {
        "type": "apiKey",
        "in": "cookie",
        "name": COOKIE,
        "description": "Of a paired browser, from `pairDevice` or `logIn`. Where the address names "
        "a port the cookie does, too (`plugpilot-8000`); over https it begins with `__Host-`.",
    },
    "key": {
        "type": "http",
        "scheme": "bearer",
        "description": "Of a program, from `createKey`. The list says what the key needs to allow.",
    },
}


def describe(app: FastAPI) -> None:
    """Add what FastAPI does not see by itself to the application's OpenAPI document."""
    original = app.openapi

    def openapi() -> Document:
        if app.openapi_schema is None:
            document = original()
            _add_messages(document)
            document["components"]["securitySchemes"] = SECURITY_SCHEMES
            problems = document["components"].setdefault("responses", {})
            for operation in _operations(document):
                _add_statuses(operation)
                _add_security(operation)
                _share_problems(operation, problems)
                _add_examples(operation)
            _add_webhooks(document)
            app.openapi_schema = document
        return app.openapi_schema

    app.openapi = openapi  # type: ignore[method-assign]


def _operations(document: Document) -> Iterator[Document]:
    for item in document["paths"].values():
        yield from item.values()


def _add_messages(document: Document) -> None:
    """Put the models into the components that no route mentions."""
    schemas = document.setdefault("components", {}).setdefault("schemas", {})
    for name, adapter, mode in (
        ("Problem", TypeAdapter(Problem), "serialization"),
        ("Event", TypeAdapter(Event), "serialization"),
        ("ServerMessage", TypeAdapter(ServerMessage), "serialization"),
        ("ClientMessage", TypeAdapter(ClientMessage), "validation"),
    ):
        schema = adapter.json_schema(ref_template=REF_TEMPLATE, mode=mode)  # type: ignore[arg-type]
        for key, value in schema.pop("$defs", {}).items():
            schemas.setdefault(key, value)
        schemas[name] = schema
    document["components"]["schemas"] = dict(sorted(schemas.items()))


def _add_statuses(operation: Document) -> None:
    """What can go wrong with any request of its kind."""
    statuses = set()
    if operation["operationId"] not in STOPS:
        statuses.add(503)  # the disk, or PlugPilot is ending
    if OPERATIONS[operation["operationId"]] is not Need.ANYONE:
        statuses |= {401, 403}
    if operation["operationId"] in COMMANDS:
        statuses.add(409)  # somebody else is in control
    if operation.get("parameters"):
        statuses.add(422)
    if "requestBody" in operation:
        statuses |= {400, 408, 413, 422}
    responses = operation["responses"]
    for status, response in problem_responses(*statuses).items():
        responses.setdefault(str(status), response)
    operation["responses"] = dict(sorted(responses.items()))


def _add_security(operation: Document) -> None:
    """Who gets in; the rights are those of the table, with the names of the scopes of keys."""
    need = OPERATIONS[operation["operationId"]]
    if need is Need.ANYONE:
        operation["security"] = []
        return
    operation["security"] = [{"session": [need.value]}]
    if need is not Need.PERSON:
        operation["security"].append({"key": [need.value]})


def _share_problems(operation: Document, problems: Document) -> None:
    """Each status is described once, with an example."""
    responses = operation["responses"]
    for status, response in responses.items():
        content = response.get("content", {}).get(MEDIA_TYPE)
        if content is not None:
            name = f"Problem{status.title()}"
            described = {MEDIA_TYPE: {**content, "example": problem_example(status)}}
            problems[name] = {"description": response["description"], "content": described}
            responses[status] = {"$ref": f"#/components/responses/{name}"}


def _add_examples(operation: Document) -> None:
    name = operation["operationId"]
    for response in operation["responses"].values():
        for content in response.get("content", {}).values():
            example = MODELS.get(_model(content))
            if example is not None:
                content["example"] = example
    body = operation.get("requestBody")
    if body is not None:
        content = body["content"]["application/json"]
        if name in REQUESTS:
            content["examples"] = REQUESTS[name]
        else:
            content["example"] = BODIES.get(name, MODELS.get(_model(content)))


def _model(content: Document) -> str:
    schema = content.get("schema", {})
    named = [each["$ref"] for each in (schema, *schema.get("anyOf", [])) if "$ref" in each]
    return str(named[0]).rpartition("/")[2] if named else ""


def _add_webhooks(document: Document) -> None:
    """Say what is sent to webhooks (OpenAPI 3.1)."""
    document["webhooks"] = {
        "event": {
            "post": {
                "operationId": "receiveEvent",
                "summary": "An event, signed as Standard Webhooks 1.0 describe",
                "description": "The headers webhook-id, webhook-timestamp and webhook-signature "
                "prove who sent it and when. Answer 2xx within 10 s; 410 ends the webhook.",
                "requestBody": {
                    "required": True,
                    "content": {
                        "application/json": {
                            "schema": {"$ref": "#/components/schemas/Event"},
                            "example": MODELS["EventPage"]["items"][0],
                        }
                    },
                },
                "responses": {"2XX": {"description": "The event has arrived"}},
            }
        }
    }
