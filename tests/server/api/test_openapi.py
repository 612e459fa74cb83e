"""The published contract."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import jsonschema_rs
import pytest

from server.access import OPERATIONS, Need
from server.api.examples import MODELS
from server.api.openapi import document
from server.api.problems import MEDIA_TYPE
from server.schema.live import ClientMessage

PUBLISHED = Path(__file__).resolve().parents[3] / "web" / "openapi.json"
METHODS = {"get", "put", "post", "delete", "patch"}
PROBLEM = {"$ref": "#/components/schemas/Problem"}
STREAMS = {
    "image/jpeg",
    "multipart/x-mixed-replace",
    "application/octet-stream",
    "application/pdf",
    "application/x-ndjson",
    "application/zip",
}


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


def _contents(contract: dict[str, Any]) -> Iterator[tuple[str, dict[str, Any]]]:
    """Everything that is JSON, in and out, of every operation and webhook."""
    for where, operation in _operations(contract):
        answers = [r for r in operation["responses"].values() if "$ref" not in r]
        for part in [*answers, *([operation["requestBody"]] if "requestBody" in operation else [])]:
            for media_type, content in part.get("content", {}).items():
                if media_type not in STREAMS and media_type != "text/event-stream":
                    assert media_type == "application/json", where
                    yield where, content
    for name, response in contract["components"]["responses"].items():
        for content in response["content"].values():
            yield name, content
    event = contract["webhooks"]["event"]["post"]
    yield "webhook", event["requestBody"]["content"]["application/json"]


def test_every_request_and_answer_has_an_example_that_is_right(contract: dict[str, Any]) -> None:
    count = 0
    for where, content in _contents(contract):
        examples = [named["value"] for named in content.get("examples", {}).values()]
        if "example" in content:
            examples.append(content["example"])
        assert examples, f"{where} has no example"
        document = {**content["schema"], "components": contract["components"]}
        validator = jsonschema_rs.validator_for(document, validate_formats=True)
        for example in examples:
            count += 1
            for error in validator.iter_errors(example):
                pytest.fail(f"{where}: {error.message} at {error.instance_path}")
    assert count > 60


def test_a_wrong_example_would_be_found(contract: dict[str, Any]) -> None:
    """The check above sees through references, formats and forbidden fields."""
    schema = {"$ref": "#/components/schemas/Webhook", "components": contract["components"]}
    validator = jsonschema_rs.validator_for(schema, validate_formats=True)
    good = MODELS["Webhook"]
    assert validator.is_valid(good)
    for wrong in ({"created_at": "yesterday"}, {"events": ["job.exploded"]}, {"extra": 1}):
        assert not validator.is_valid({**good, **wrong}), wrong


def test_every_operation_says_who_gets_in(contract: dict[str, Any]) -> None:
    assert set(contract["components"]["securitySchemes"]) == {"session", "key"}
    for where, operation in _operations(contract):
        need = OPERATIONS[operation["operationId"]]
        ways = [name for way in operation["security"] for name in way]
        expected = {Need.ANYONE: [], Need.PERSON: ["session"]}.get(need, ["session", "key"])
        assert ways == expected, where
        assert ("401" in operation["responses"]) == bool(ways), where


def test_every_list_comes_in_pages(contract: dict[str, Any]) -> None:
    lists = 0
    for where, operation in _operations(contract):
        for response in operation["responses"].values():
            schema = response.get("content", {}).get("application/json", {}).get("schema", {})
            model = contract["components"]["schemas"].get(_name(schema.get("$ref", "")), {})
            if "items" in model.get("properties", {}):
                lists += 1
                assert "next_cursor" in model["properties"], where
                names = {parameter["name"] for parameter in operation["parameters"]}
                assert {"cursor", "limit"} <= names, where
    assert lists >= 6


def _name(reference: str) -> str:
    return reference.rpartition("/")[2]


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
        assert operation["summary"].strip(), where
        assert operation["description"].strip(), where
        assert any(code.startswith("2") for code in operation["responses"]), where
        assert "default" in operation["responses"], where
        for code, response in operation["responses"].items():
            if not code.startswith("2"):
                shared = contract["components"]["responses"][_name(response["$ref"])]
                assert shared["content"][MEDIA_TYPE]["schema"] == PROBLEM, f"{where} {code}"
                assert list(shared["content"]) == [MEDIA_TYPE]
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
    assert kinds == {"stop", "emergency_stop", "jog", "jog_step", "move_to", "jog_end", "resync"}
    assert len(kinds) == len(ClientMessage.__origin__.__args__)  # type: ignore[attr-defined]


def test_it_is_the_same_every_time() -> None:
    assert document() == document()
