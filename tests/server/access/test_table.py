"""The table of operations: complete, without leftovers, and obeyed for every role and scope."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from server.access import MESSAGES, OPERATIONS, Need, Role, Scope
from server.access.operations import FREQUENT, LARGE_BODIES, LIMITED, STOPS
from server.access.rights import ROLE_RIGHTS, SCOPE_RIGHTS
from server.api.app import create_app
from server.api.gate import RouteTable
from server.api.gate.caller import MACHINE_RIGHTS
from server.api.openapi import _never_started
from twin.camera_mount import CameraMount
from twin.geometry import RobotGeometry
from twin.scene import TwinHost

CONTRACT = Path(__file__).resolve().parents[3] / "web" / "openapi.json"
EXPLAINED = "add a line to server/access/operations.py that says what it needs"


@pytest.fixture(scope="module")
def contract() -> dict[str, Any]:
    content: dict[str, Any] = json.loads(CONTRACT.read_text())
    return content


@pytest.fixture(scope="module")
def routes() -> RouteTable:
    """Every route of the application, with the 3D picture."""
    app = create_app(_never_started, TwinHost(RobotGeometry(), CameraMount(), 1.0, 4 / 3))
    return RouteTable(app.routes, OPERATIONS)


def _messages(contract: Mapping[str, Any]) -> set[str]:
    schemas = contract["components"]["schemas"]
    return {
        schemas[option["$ref"].rsplit("/", 1)[1]]["properties"]["type"]["const"]
        for option in schemas["ClientMessage"]["oneOf"]
    }


def test_every_operation_of_the_contract_stands_in_the_table(contract: dict[str, Any]) -> None:
    missing = [
        f"{operation['operationId']} ({method.upper()} {path})"
        for path, item in contract["paths"].items()
        for method, operation in item.items()
        if operation["operationId"] not in OPERATIONS
    ]
    assert not missing, f"nobody may use these; {EXPLAINED}:\n" + "\n".join(missing)


def test_every_other_route_stands_in_the_table(routes: RouteTable) -> None:
    assert len(routes.operations) > 50, "the routes were not found"
    assert not routes.unlisted, f"nobody may use these; {EXPLAINED}: {routes.unlisted}"


def test_the_table_speaks_of_nothing_that_does_not_exist(routes: RouteTable) -> None:
    names = {operation.name for operation in routes.operations}
    assert set(OPERATIONS) - names == set(), "these are gone; take them out of the table"
    for subset in (LIMITED, STOPS, FREQUENT, set(LARGE_BODIES)):
        assert set(subset) <= names


def test_every_message_stands_in_the_table(contract: dict[str, Any]) -> None:
    assert _messages(contract) == set(MESSAGES), f"{EXPLAINED}, in MESSAGES"


def test_whoever_is_paired_may_stop() -> None:
    assert {"stopRobot", "emergencyStopRobot"} == STOPS
    assert MESSAGES["stop"] is MESSAGES["emergency_stop"] is Need.STOP
    for role in Role:
        assert Need.STOP in ROLE_RIGHTS[role]
    assert Need.STOP in MACHINE_RIGHTS


def test_only_owners_and_admin_keys_decide_who_may_do_what() -> None:
    assert {role for role in Role if Need.ADMIN in ROLE_RIGHTS[role]} == {Role.OWNER}
    assert {scope for scope in Scope if Need.ADMIN in SCOPE_RIGHTS[scope]} == {Scope.ADMIN}


def test_a_stranger_may_do_little() -> None:
    assert {name for name, need in OPERATIONS.items() if need is Need.ANYONE} == {
        "GET /",
        "GET /technician",
        "GET /kiosk",
        "GET /assets/{name}",
        "GET /icons/{name}",
        "GET /manifest.webmanifest",
        "GET /worker.js",
        "GET /root.crt",
        "getHealth",
        "getSession",
        "pairDevice",
        "showOwnerInvitation",
        "beginLogin",
        "logIn",
    }
