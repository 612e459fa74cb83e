"""Examples of what the technician's page asks for, for the OpenAPI document."""

from __future__ import annotations

from typing import Any

Json = Any

_NOW = "2026-03-01T18:04:05.120Z"

_INSPECTION: dict[str, Json] = {
    "sequence": 42,
    "taken_at": _NOW,
    "width_px": 1640,
    "height_px": 1232,
    "age_s": 0.0871,
    "frames_per_s": 29.97,
    "exposure_ms": 8.0,
    "brightness": 108.4,
    "dark_share": 0.0021,
    "bright_share": 0.0004,
    "label": {
        "payload": "PP2:zoe:4NG43RRFJW",
        "vehicle_id": "zoe",
        "outline_px": [[612.4, 388.1], [861.9, 391.6], [858.2, 640.7], [609.8, 636.0]],
        "centre_px": [735.61, 514.07],
        "pose": {
            "source": "edges",
            "position_mm": [-14.231, 7.9, 318.442],
            "position_sigma_mm": [0.00412, 0.00398, 0.02103],
            "turn_deg": [1.204, -0.871, 0.402],
            "turn_sigma_deg": [0.02113, 0.01987, 0.00304],
            "axes_px": [[860.2, 516.2], [733.9, 638.4], [742.0, 509.3]],
            "ellipse": {"major_px": 0.013312, "minor_px": 0.012204, "angle_rad": 0.4121},
            "residual_px": 0.0814,
            "inlier_share": 0.9781,
            "measurements": 1264,
        },
    },
    "trouble": None,
}

_TARGET: dict[str, Json] = {
    "id": "0d4b7b0e-6f0b-4a53-9a55-7a2f0c1b9d11",
    "tip": {"x_mm": 700.0, "y_mm": 360.0, "z_mm": 142.0},
    "joints": {"rho1_mm": 489.132, "rho2_mm": 611.07, "rho3_mm": 50.0},
    "way": [
        {"x_mm": 616.0, "y_mm": 335.0, "z_mm": 142.0},
        {"x_mm": 658.0, "y_mm": 347.5, "z_mm": 142.0},
        {"x_mm": 700.0, "y_mm": 360.0, "z_mm": 142.0},
    ],
    "distance_mm": 87.641,
    "duration_s": 9.014,
    "forces": [
        {"joint": "rho1", "force_n": 61.2, "limit_n": 150.0, "share": 0.408, "at_s": 9.014},
        {"joint": "rho2", "force_n": -58.7, "limit_n": 150.0, "share": 0.3913, "at_s": 0.0},
        {"joint": "rho3", "force_n": -9.4, "limit_n": 120.0, "share": 0.0783, "at_s": 0.0},
    ],
}

TECHNICIAN_MODELS: dict[str, Json] = {
    "CameraInspection": _INSPECTION,
    "MoveTarget": _TARGET,
    "ConfigurationFields": {
        "fields": [
            {
                "key": "webhooks.timeout_s",
                "kind": "number",
                "words": "Longest time of one attempt",
                "optional": False,
                "choices": [],
                "least": 0,
                "most": 60,
                "changeable": True,
            }
        ]
    },
    "ConfigurationCheck": {
        "troubles": [],
        "differences": [{"key": "webhooks.timeout_s", "before": 10.0, "after": 5.0}],
    },
    "ConfigurationHistory": {
        "versions": [
            {
                "number": 2,
                "at": _NOW,
                "by": "person: Anna",
                "changes": {"webhooks": {"timeout_s": 5}},
            },
            {"number": 0, "at": None, "by": "", "changes": {}},
        ]
    },
    "Versions": {
        "software": "0.1.0",
        "python": "3.11.9",
        "system": "Linux 6.6.31 aarch64",
        "libraries": [{"name": "fastapi", "version": "0.115.6"}],
        "board": "Me Auriga",
        "firmware": "1.0.0",
        "protocol_hash": "13345a36",
        "releases": [
            {
                "version": "0.1.0",
                "released_on": "2026-11-22",
                "changes": ["Plugs in and unplugs by itself, from a phone or over REST."],
            }
        ],
    },
    "ProtocolFrames": {
        "frames": [
            {
                "number": 1041,
                "at": _NOW,
                "direction": "to_board",
                "kind": "Heartbeat",
                "words": "seq=0 ack=0",
                "size_bytes": 8,
                "error": False,
            },
            {
                "number": 1042,
                "at": _NOW,
                "direction": "from_board",
                "kind": "Event",
                "words": "seq=3 ack=18 kind=REFUSED code=8 seq=17 detail=0 tick=812034",
                "size_bytes": 16,
                "error": True,
            },
        ],
        "newest": 1042,
        "lost": 0,
        "available": True,
    },
    "LinkReport": {
        "at": _NOW,
        "online": True,
        "telemetry_hz": 10.01,
        "sample_age_s": 0.0613,
        "sample_delay_s": 0.0021,
        "round_trip": {
            "newest_s": 0.0012,
            "median_s": 0.0013,
            "worst_s": 0.0041,
            "answers": 32,
        },
        "received": 18204,
        "damaged": 0,
        "damaged_at_board": 0,
        "sent_again": 0,
        "reconnections": 0,
        "supply_v": 12.08,
        "temperature_degc": 31.4,
    },
    "TargetRequest": {"x_mm": 700.0, "y_mm": 360.0, "speed_mm_s": 10.0},
}
