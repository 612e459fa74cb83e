"""Examples of what crosses the network about control, for the OpenAPI document."""

from __future__ import annotations

from typing import Any

Json = Any

_ANNA: dict[str, Json] = {
    "id": "01957a10-2b4c-7e55-9a31-6f0d2c8e4b17",
    "name": "Anna",
    "role": "owner",
}
_BEN: dict[str, Json] = {
    "id": "01957a3b-a1c0-7c3d-8e52-4d1b9f7a2c06",
    "name": "Ben",
    "role": "technician",
}
_REQUEST_ID = "7d0f8f0e-3c63-4a0c-9d0b-2a54f2f4f0c1"

CONTROL_MODELS: dict[str, Json] = {
    "Control": {
        "holder": {
            "person": _ANNA,
            "since": "2026-03-01T18:03:41.700Z",
            "ends_at": "2026-03-01T18:05:02.300Z",
        },
        "request": {
            "id": _REQUEST_ID,
            "person": _BEN,
            "asked_at": "2026-03-01T18:04:05.120Z",
            "ends_at": "2026-03-01T18:04:35.120Z",
        },
        "answer": None,
    },
    "ControlReply": {"request_id": _REQUEST_ID, "give": True},
}
