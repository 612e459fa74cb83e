"""Every operation and every message, tried by every role and every scope."""

from __future__ import annotations

import httpx
import pytest

from server.access import MESSAGES, OPERATIONS, TWIN_MESSAGES, Access, Caller, Role, Scope
from server.access.errors import ForbiddenError
from server.access.limits import Attempts
from server.access.operations import twin_messages
from server.access.rights import NO_RIGHTS, ROLE_RIGHTS, SCOPE_RIGHTS, Rights
from server.api.gate import admit_message
from server.api.gate.caller import COOKIE
from server.api.gate.routes import WEBSOCKET
from server.api.gate.watch import UNPAIRED
from tests.support.front_door import HOST, FrontDoor, example_of
from tests.support.garage import Scene, on_scene
from tests.support.pairing import new_device, new_key

EVERYBODY: dict[str, Rights] = {
    "nobody": NO_RIGHTS,
    **{role.value: ROLE_RIGHTS[role] for role in Role},
    **{f"key {scope.value}": SCOPE_RIGHTS[scope] for scope in Scope},
}


async def _credentials(access: Access) -> dict[str, dict[str, str]]:
    headers: dict[str, dict[str, str]] = {"nobody": {}}
    for role in Role:
        headers[role.value] = {"Cookie": f"{COOKIE}={await new_device(access, role)}"}
    for scope in Scope:
        headers[f"key {scope.value}"] = {"Authorization": f"Bearer {await new_key(access, scope)}"}
    return headers


def test_every_operation_for_everybody() -> None:
    """Exactly what the table says is let in; everything else is refused alike."""

    async def scenario(scene: Scene) -> int:
        door, tried = FrontDoor(scene.services), 0
        scene.services.access.attempts = Attempts(attempts=10_000)
        everybody = await _credentials(scene.services.access)
        transport = httpx.ASGITransport(door, client=("192.0.2.7", 50_000))
        async with httpx.AsyncClient(transport=transport, base_url=f"http://{HOST}") as client:
            for operation in door.operations:
                method, path = example_of(operation)
                for who, headers in everybody.items():
                    door.let_in.clear()
                    allowed = operation.need in EVERYBODY[who]
                    if method == WEBSOCKET:
                        (message,) = await door.open_socket(path, headers)
                        refusal = {"type": "websocket.close", "code": UNPAIRED, "reason": ""}
                        assert message == ({"type": "websocket.accept"} if allowed else refusal)
                    else:
                        answer = await client.request(method, path, headers=headers)
                        refused = (401, "not_paired") if who == "nobody" else (403, "forbidden")
                        assert answer.status_code == (204 if allowed else refused[0]), (
                            f"{who}: {operation.name}"
                        )
                        if not allowed:
                            assert answer.json()["code"] == refused[1]
                    assert door.let_in == ([path] if allowed else []), f"{who}: {operation.name}"
                    tried += 1
        return tried

    assert on_scene(scenario, parked=False) == len(OPERATIONS) * len(EVERYBODY)


@pytest.mark.parametrize("kind", [*MESSAGES, "dance"])
def test_every_message_for_everybody(kind: str) -> None:
    async def scenario(scene: Scene) -> None:
        access = scene.services.access
        for who, headers in (await _credentials(access)).items():
            secret = next(iter(headers.values()), "").rsplit("=", 1)[-1].removeprefix("Bearer ")
            caller = access.register.caller(secret, "192.0.2.7") or Caller(
                "unknown", "", "", NO_RIGHTS, "192.0.2.7"
            )
            assert caller.rights == EVERYBODY[who]
            if MESSAGES.get(kind) in EVERYBODY[who]:
                admit_message(access, caller, kind)
            else:
                with pytest.raises(ForbiddenError):
                    admit_message(access, caller, kind)

    on_scene(scenario, parked=False)


@pytest.mark.parametrize("who", EVERYBODY)
def test_the_3d_picture_takes_only_what_is_needed_to_look(who: str) -> None:
    rights = EVERYBODY[who]
    expected = {kind for kind, need in TWIN_MESSAGES.items() if need in rights}
    assert twin_messages(rights) == expected
    assert expected <= {"ViewerCameraMessage"}


def test_the_messages_of_the_3d_client_are_spelt_as_the_library_spells_them() -> None:
    from viser import _messages  # noqa: PLC0415 - loaded only where it is looked at

    names = {name for name in dir(_messages) if name.endswith(("Message", "Request"))}
    assert set(TWIN_MESSAGES) <= names
    assert "ShareUrlRequest" in names
