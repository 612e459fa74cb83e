"""Requests made from the published contract, good and bad ones, against a real server.

Whatever is sent, the server answers with a status that the operation documents and a body that
fits, and never with an error of its own. `make fuzz` does the same at length.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from typing import Any

import pytest
from hypothesis import HealthCheck, Phase, settings
from schemathesis import Case

from tests.support.contract import ENDLESS, SCHEMA, check_answer
from tests.support.process import ServerProcess, serving

EXAMPLES = int(os.environ.get("FUZZ_EXAMPLES", "0"))
"""For each operation; 0 takes few, and the same ones every time."""


@pytest.fixture(scope="module")
def live(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ServerProcess]:
    file = tmp_path_factory.mktemp("fuzz") / "plugpilot.toml"
    file.write_text('[webhooks]\nallowed_networks = ["127.0.0.0/8"]\n')
    with serving(f"--config={file}") as process:
        yield process


@SCHEMA.exclude(operation_id=ENDLESS).parametrize()
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
    check_answer(case, live)
