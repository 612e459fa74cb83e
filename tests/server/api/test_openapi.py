"""The published contract."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from server.api.openapi import document
from server.api.problems import MEDIA_TYPE
from server.schema.live import ClientMessage

PUBLISHED = Path(__file__).resolve().parents[3] / "web" / "openapi.json"
METHODS = {"get", "put", "post", "delete", "patch"}
PROBLEM = {MEDIA_TYPE: {"schema": {"$ref": "#/components/schemas/Problem"}}}


@pytest.fixture(scope="module")
def contract() -> dict[str, Any]:
    content: dict[str, Any] = json.loads(document())
    return content


def _operations(contract: dict[str, Any]) -> Iterator[tuple[str, dict[str, Any]]]:
    for path, item in contract["paths"].items():
        assert set(item) <= METHODS
        for method, operation in item.items():
            yield f"{method} {path}", operation


def _references(part: object) -> Iterator[str]:
    if isinstance(part, dict):
        if isinstance(part.get("$ref"), str):
            yield part["$ref"]
        if isinstance(part.get("discriminator"), dict):
            yield from part["discriminator"].get("mapping", {}).values()
        for value in part.values():
            yield from _references(value)
    elif isinstance(part, list):
        for value in part:
            yield from _references(value)


def test_what_is_published_is_what_is_served() -> None:
    assert PUBLISHED.read_text() == document(), (
        "the API has changed: run `python -m server.api.openapi > web/openapi.json`, "
        "then `npm run types` in web/"
    )


def test_every_reference_leads_somewhere(contract: dict[str, Any]) -> None:
    references = set(_references(contract))
    assert len(references) > 30
    for reference in references:
        place: Any = contract
        assert reference.startswith("#/")
        for step in reference[2:].split("/"):
            assert step in place, reference
            place = place[step]


def test_every_schema_is_used_or_a_message(contract: dict[str, Any]) -> None:
    used = {reference.rsplit("/", 1)[1] for reference in _references(contract)}
    assert set(contract["components"]["schemas"]) - used == {"ServerMessage", "ClientMessage"}


def test_every_operation_is_named_and_documents_what_can_go_wrong(
    contract: dict[str, Any],
) -> None:
    names = []
    for where, operation in _operations(contract):
        names.append(operation["operationId"])
        assert re.fullmatch(r"[a-z]+[A-Z][A-Za-z]+", operation["operationId"]), where
        assert operation["description"].strip(), where
        assert any(code.startswith("2") for code in operation["responses"]), where
        assert "default" in operation["responses"], where
        for code, response in operation["responses"].items():
            if not code.startswith("2"):
                assert response["content"] == PROBLEM, f"{where} {code}"
    assert len(set(names)) == len(names)
    assert "createJob" in names


def test_parameters_in_paths_are_declared(contract: dict[str, Any]) -> None:
    for path, item in contract["paths"].items():
        for operation in item.values():
            declared = {p["name"] for p in operation.get("parameters", []) if p["in"] == "path"}
            assert declared == set(re.findall(r"{(\w+)}", path)), path


def test_the_messages_of_the_socket_are_part_of_it(contract: dict[str, Any]) -> None:
    schemas = contract["components"]["schemas"]
    kinds = {
        schemas[option["$ref"].rsplit("/", 1)[1]]["properties"]["type"]["const"]
        for option in schemas["ClientMessage"]["oneOf"]
    }
    assert kinds == {"stop", "emergency_stop", "jog", "jog_step", "jog_end", "resync"}
    assert len(kinds) == len(ClientMessage.__origin__.__args__)  # type: ignore[attr-defined]


def test_it_is_the_same_every_time() -> None:
    assert document() == document()
