"""Examples of what crosses the network about access, for the OpenAPI document."""

from __future__ import annotations

from typing import Any

Json = Any

_NOW = "2026-03-01T18:04:05.120Z"
_PAIRED_AT = "2026-02-20T09:12:00Z"
_PERSON: dict[str, Json] = {
    "id": "01957a10-2b4c-7e55-9a31-6f0d2c8e4b17",
    "name": "Anna",
    "role": "owner",
    "ends_at": None,
}
_DEVICE: dict[str, Json] = {
    "id": "01957a10-2b60-7b1a-8c42-17e5d90a3f6c",
    "name": "Chrome on Android",
    "created_at": _PAIRED_AT,
    "last_used_at": _NOW,
    "last_from": "192.168.1.34",
}
_PERSON_ENTRY = {**_PERSON, "created_at": _PAIRED_AT, "devices": [_DEVICE], "passkeys": 1}
_INVITATION: dict[str, Json] = {
    "id": "01957a3b-90aa-7d6e-b1f4-0c2a5e7d8b93",
    "name": "Ben",
    "role": "technician",
    "created_by": "person: Anna",
    "created_at": _NOW,
    "expires_at": "2026-03-01T18:19:05.120Z",
    "ends_at": "2026-03-02T18:04:05.120Z",
}
_KEY: dict[str, Json] = {
    "id": "01957a3c-11d2-7a09-93e8-5b6c7d8e9f01",
    "name": "Home Assistant",
    "hint": "kQ4z",
    "scopes": ["read", "operate"],
    "created_by": "person: Anna",
    "created_at": _PAIRED_AT,
    "last_used_at": _NOW,
    "last_from": "192.168.1.10",
}
_PASSKEY: dict[str, Json] = {
    "id": "01957a10-3000-7c1d-a2b3-c4d5e6f70819",
    "name": "Chrome on Android",
    "created_at": _PAIRED_AT,
    "last_used_at": None,
}

_PUSH_KEY = (
    "BA1Hxzyi1RUM1b5wjxsn7nGxAszw2u61m164i3MrAIxHF6YK5h4SDYic-dRuU_RCPCfA5aq9ojSwk5Y2EmClBPs"
)

ACCESS_MODELS: dict[str, Json] = {
    "PushState": {"public_key": _PUSH_KEY, "subscribed": False},
    "PushSubscription": {
        "endpoint": "https://push.example.net/send/bGF0ZXI",
        "p256dh": _PUSH_KEY,
        "auth": "BTBZMqHH6r4Tts7J_aSIgg",
        "language": "de",
    },
    "AccessSession": {
        "paired": True,
        "person": _PERSON,
        "device_id": _DEVICE["id"],
        "rights": [
            "admin",
            "anyone",
            "charge-point",
            "operate",
            "person",
            "read",
            "service",
            "stop",
        ],
        "passkeys": True,
        "screen": False,
    },
    "AuditPage": {
        "items": [
            {
                "sequence": 42,
                "at": _NOW,
                "event": "operation",
                "actor": "person: Anna",
                "address": "192.168.1.34",
                "detail": {"operation": "createJob", "path": "/api/v1/jobs", "status": 201},
                "times": 1,
                "chain": "6a09e667bb67ae853c6ef372a54ff53a510e527f9b05688c1f83d9ab5be0cd19",
            }
        ],
        "next_cursor": "42",
    },
    "InvitationList": {"items": [_INVITATION], "next_cursor": None},
    "InvitationRequest": {
        "name": "Ben",
        "role": "technician",
        "valid_minutes": 15,
        "ends_at": _INVITATION["ends_at"],
    },
    "IssuedInvitation": {
        "address": "http://plugpilot.local:8000/#pair=Zk3vTq9xR2mB7wYc",
        "qr": "data:image/svg+xml;base64,PHN2ZyB4bWxucz0iaHR0cDovL3d3dy53My5vcmcvMjAwMC9zdmciLz4=",
        "reachable": True,
        "expires_at": _INVITATION["expires_at"],
    },
    "IssuedKey": {
        **_KEY,
        "last_used_at": None,
        "last_from": None,
        "key": "plugpilot_SHOWN-ONCE-kQ4z",
    },
    "KeyList": {"items": [_KEY], "next_cursor": None},
    "KeyRequest": {"name": _KEY["name"], "scopes": _KEY["scopes"]},
    "PairingRequest": {"secret": "Zk3vTq9xR2mB7wYc"},
    "PasskeyAnswer": {
        "credential": {
            "id": "q83vEjRWeJASNFZ4kBI0Vg",
            "rawId": "q83vEjRWeJASNFZ4kBI0Vg",
            "type": "public-key",
            "response": {"clientDataJSON": "eyJ0eXBlIjoi4oCmIn0", "authenticatorData": "SZYN5Y"},
        }
    },
    "PasskeyEntry": _PASSKEY,
    "PasskeyList": {"items": [_PASSKEY], "next_cursor": None},
    "PasskeyOptions": {
        "options": {
            "challenge": "3hVb0kq8mXw2sZ5nT7rYcA",
            "rpId": "plugpilot.local",
            "timeout": 60000,
            "userVerification": "required",
        }
    },
    "PersonEntry": _PERSON_ENTRY,
    "PersonList": {"items": [_PERSON_ENTRY], "next_cursor": None},
    "PersonSettings": {"name": "Anna", "role": "owner", "ends_at": None},
}
"""By the name of the schema."""
