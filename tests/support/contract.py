"""The published contract as a source of requests, and as the judge of answers."""

from __future__ import annotations

import functools
import json
from http import HTTPStatus
from pathlib import Path
from typing import Any

import jsonschema_rs
import schemathesis
from schemathesis import Case
from schemathesis.checks import not_a_server_error
from schemathesis.specs.openapi.checks import (
    content_type_conformance,
    response_headers_conformance,
    status_code_conformance,
)

from server.access import OPERATIONS, Need
from server.api.problems import MEDIA_TYPE
from tests.support.process import ServerProcess

PUBLISHED = Path(__file__).parents[2] / "web" / "openapi.json"
CONTRACT: dict[str, Any] = json.loads(PUBLISHED.read_text())
ENDLESS = ["streamEvents", "streamCamera"]
"""They never end; what they send is tested elsewhere."""

PATIENCE_S = 20
CHECKS = [
    not_a_server_error,
    status_code_conformance,
    content_type_conformance,
    response_headers_conformance,
]
PROBLEM = {"$ref": "#/components/responses/ProblemDefault"}
JSON = {"application/json", MEDIA_TYPE}
NOWHERE = "https://127.0.0.1:1/hook"

SCHEMA = schemathesis.openapi.from_dict(CONTRACT)
SCHEMA.config.generation.update(with_security_parameters=False)  # the owner's cookie is sent


def check_answer(case: Case[Any], server: ServerProcess) -> None:
    """Send a request as the owner.

    Raises:
        AssertionError, Exception: the answer is not a documented one.
    """
    _keep_at_home(case)
    name = case.operation.definition.raw["operationId"]
    # The owner, for whom nothing is refused; but the owner stays paired.
    headers = {} if name == "endSession" else server.headers
    response = case.call(base_url=server.url, headers=headers, timeout=PATIENCE_S)
    case.validate_response(response, checks=CHECKS)
    documented = set(case.operation.definition.raw["responses"])
    if case.method != case.operation.method.upper():
        documented.add("405")
    assert str(response.status_code) in documented, (
        f"{response.status_code} is not documented: {response.text[:300]}"
    )
    if headers and OPERATIONS[name] is not Need.ANYONE:
        assert response.status_code != 401, "the owner was not let in: nothing is tested"
    answer = case.operation.definition.raw["responses"].get(str(response.status_code), PROBLEM)
    if response.status_code == HTTPStatus.NO_CONTENT:
        assert not response.content, "an answer without content has some"
        assert "content-type" not in response.headers, "it names a type of nothing"
    elif response.headers.get("content-type", [""])[0] in JSON:
        fitting = _validator(json.dumps(answer))
        errors = [f"{e.message} at {e.instance_path}" for e in fitting.iter_errors(response.json())]
        assert not errors, errors


@functools.cache
def _validator(documented: str) -> jsonschema_rs.Validator:
    """Of an answer. The tool's own check stumbles over tuples (prefixItems)."""
    answer: dict[str, Any] = json.loads(documented)
    if "$ref" in answer:
        answer = CONTRACT["components"]["responses"][answer["$ref"].rpartition("/")[2]]
    (content,) = answer["content"].values()
    document = {**content["schema"], "components": CONTRACT["components"]}
    return jsonschema_rs.validator_for(document, validate_formats=True)


def _keep_at_home(case: Case[Any]) -> None:
    """No webhook made here may knock at a door outside."""
    if isinstance(case.body, dict) and str(case.body.get("url", "")).startswith("http"):
        case.body["url"] = NOWHERE
