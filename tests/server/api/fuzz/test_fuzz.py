"""Requests made from the published contract, good and bad ones, against a real server.

Whatever is sent, the server answers with a status that the operation documents and a body that
fits, and never with an error of its own. `make fuzz-api` does the same at length.
"""

from __future__ import annotations

import functools
import json
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import jsonschema_rs
import pytest
import schemathesis
from hypothesis import HealthCheck, Phase, settings
from schemathesis import Case
from schemathesis.checks import not_a_server_error
from schemathesis.specs.openapi.checks import (
    content_type_conformance,
    response_headers_conformance,
    status_code_conformance,
)

from server.api.problems import MEDIA_TYPE
from tests.support.process import ServerProcess, serving

PUBLISHED = Path(__file__).parents[4] / "web" / "openapi.json"
CONTRACT: dict[str, Any] = json.loads(PUBLISHED.read_text())
ENDLESS = ["streamEvents", "streamCamera"]
"""They never end; what they send is tested elsewhere."""

EXAMPLES = int(os.environ.get("FUZZ_EXAMPLES", "0"))
"""For each operation; 0 takes few, and the same ones every time."""

CHECKS = [
    not_a_server_error,
    status_code_conformance,
    content_type_conformance,
    response_headers_conformance,
]
PROBLEM = {"$ref": "#/components/responses/ProblemDefault"}
JSON = {"application/json", MEDIA_TYPE}
NOWHERE = "https://127.0.0.1:1/hook"

schema = schemathesis.openapi.from_dict(CONTRACT)


@pytest.fixture(scope="module")
def live(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ServerProcess]:
    file = tmp_path_factory.mktemp("fuzz") / "plugpilot.toml"
    file.write_text('[webhooks]\nallowed_networks = ["127.0.0.0/8"]\n')
    with serving(f"--config={file}") as process:
        yield process


@schema.exclude(operation_id=ENDLESS).parametrize()
@settings(
    max_examples=EXAMPLES or 10,
    derandomize=EXAMPLES == 0,
    database=None,
    deadline=None,
    # The explicit ones are made by the dozen, one for each way in which a field can be wrong.
    phases=[Phase.explicit, Phase.generate] if EXAMPLES else [Phase.generate],
    suppress_health_check=list(HealthCheck),
)
def test_every_answer_is_documented(case: Case[Any], live: ServerProcess) -> None:
    _keep_at_home(case)
    response = case.call(base_url=live.url, headers=_headers(case, live), timeout=20)
    case.validate_response(response, checks=CHECKS)
    documented = set(case.operation.definition.raw["responses"])
    if case.method != case.operation.method.upper():
        documented.add("405")
    assert str(response.status_code) in documented, (
        f"{response.status_code} is not documented: {response.text[:300]}"
    )
    if response.headers.get("content-type", [""])[0] in JSON:
        answer = case.operation.definition.raw["responses"].get(str(response.status_code), PROBLEM)
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


def _headers(case: Case[Any], live: ServerProcess) -> dict[str, str]:
    """The owner's, for whom nothing is refused; but the owner stays signed in."""
    if case.operation.definition.raw["operationId"] == "endSession":
        return {}
    return live.headers


def _keep_at_home(case: Case[Any]) -> None:
    """No webhook made here may knock at a door outside."""
    if isinstance(case.body, dict) and str(case.body.get("url", "")).startswith("http"):
        case.body["url"] = NOWHERE
