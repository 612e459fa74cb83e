"""Examples of everything that crosses the network, for the OpenAPI document.

They are plain JSON, so that they show what a client sees. A test checks each against its schema.
"""

from __future__ import annotations

from typing import Any

from server.api.access_examples import ACCESS_MODELS
from server.api.calibration_examples import CALIBRATION_MODELS, CALIBRATION_REQUESTS
from server.api.control_examples import CONTROL_MODELS
from server.api.technician_examples import TECHNICIAN_MODELS

Json = Any

NOW = "2026-03-01T18:04:05.120Z"
JOB_ID = "01957a3c-7d50-7c44-8e0f-5b3c9d5a1f00"
EVENT_ID = "01957a3d-02f6-7a10-9c1b-0d5c8d3b6a42"
WEBHOOK_ID = "01957a2f-5c11-7d0e-b0d6-61a3f9c3e7aa"

_JOINTS = {"rho1_mm": 412.5, "rho2_mm": 688.25, "rho3_mm": 50.0}
_TIP = {"x_mm": 616.0, "y_mm": 335.0, "z_mm": 142.0}
_JOB: dict[str, Json] = {
    "id": JOB_ID,
    "type": "charge",
    "state": "running",
    "phase": "charging",
    "vehicle_id": "zoe",
    "target_energy_wh": 12000,
    "created_at": "2026-03-01T18:02:11.400Z",
    "updated_at": NOW,
    "phase_started_at": "2026-03-01T18:02:58.020Z",
    "cancel_requested": False,
    "result": {
        "insertion_depth_mm": 39.9,
        "lateral_error_mm": 0.21,
        "lateral_sigma_mm": 0.05,
        "max_force_n": 68.4,
        "energy_wh": None,
        "plugged_after_s": 46.6,
        "limit_duration_s": 31.2,
    },
    "error": None,
    "recording": None,
}
_VEHICLE_SETTINGS: dict[str, Json] = {
    "name": "Renault Zoe",
    "label_size_mm": 60.0,
    "socket": {
        "x_mm": 120.0,
        "y_mm": -4.5,
        "z_mm": 0.0,
        "rotation_x_rad": 0.0,
        "rotation_y_rad": 0.02,
    },
}
_VEHICLE = {**_VEHICLE_SETTINGS, "id": "zoe", "label_payload": "PP2:zoe:4NG43RRFJW"}
_WEBHOOK_SETTINGS: dict[str, Json] = {
    "url": "https://example.com/plugpilot",
    "events": ["job.ended", "robot.needs_person"],
    "description": "Messages to my phone",
    "enabled": True,
}
_WEBHOOK = {
    **_WEBHOOK_SETTINGS,
    "id": WEBHOOK_ID,
    "disabled_reason": None,
    "created_at": "2026-02-20T09:12:00Z",
}
_DELIVERY: dict[str, Json] = {
    "id": "01957a3d-0300-7b22-8f63-1d0c7a5e9b01",
    "event_id": EVENT_ID,
    "event_type": "job.ended",
    "state": "waiting",
    "created_at": NOW,
    "next_attempt_at": "2026-03-01T18:04:10.220Z",
    "attempts": [
        {"at": NOW, "status": 503, "error": "It answered 503.", "duration_s": 0.084},
    ],
}

MODELS: dict[str, Json] = {
    **ACCESS_MODELS,
    **TECHNICIAN_MODELS,
    **CONTROL_MODELS,
    **CALIBRATION_MODELS,
    "ChargePoint": {
        "cp_state": "C",
        "enabled": True,
        "power_w": 7340.2,
        "energy_kwh": 812.3071,
        "currents_a": [31.9, 0.0, 0.0],
        "contactor_closed": True,
        "connector_locked": True,
        "max_current_a": 32.0,
        "limits_current": True,
        "robot_state": "charging",
        "resting": None,
        "updated_at": NOW,
    },
    "Configuration": {
        "changeable": ["charge_point", "logging", "webhooks"],
        "settings": {
            "logging": {"level": "info"},
            "server": {"host": "127.0.0.1", "port": 8000},
        },
    },
    "CurrentLimit": {"max_current_a": 16},
    "Delivery": _DELIVERY,
    "DeliveryPage": {"items": [_DELIVERY], "next_cursor": None},
    "Enablement": {"enabled": True},
    "EventPage": {
        "items": [
            {
                "id": EVENT_ID,
                "timestamp": NOW,
                "type": "plug.changed",
                "data": {"plug": "inserted", "before": "free"},
            }
        ],
        "next_cursor": None,
        "complete": True,
    },
    "Outlook": {"milestone": "charged", "at": "2026-03-01T20:14:00Z", "latest": False},
    "Guidance": {
        "state": "move",
        "since": "2026-03-01T18:04:03.400Z",
        "arriving": True,
        "reason": "rolls",
        "headline": "Go on forward",
        "detail": "Still 35 cm to go.",
        "remedy": "",
        "steps": [{"direction": "forward", "distance_mm": 352.4, "shown_cm": 35}],
        "car": {
            "vehicle_id": "zoe",
            "x_mm": 642.1,
            "y_mm": 318.7,
            "z_mm": 592.0,
            "sigma_x_mm": 0.4,
            "sigma_z_mm": 2.1,
            "correlation_xz": 0.12,
            "velocity_x_mm_s": 1.5,
            "velocity_z_mm_s": -240.0,
            "still": False,
            "skew_deg": 0.8,
            "skew_sigma_deg": 0.3,
            "turned_deg": -0.6,
            "distance_mm": 655.2,
            "margin_mm": -352.4,
            "seen_at": NOW,
        },
        "zones": {
            "good": [[560.0, 225.0], [740.0, 225.0], [740.0, 255.0], [560.0, 255.0]],
            "reachable": [[540.0, 215.0], [760.0, 215.0], [760.0, 275.0], [540.0, 275.0]],
            "stop_z_mm": 240.0,
        },
        "driver_faces": "robot",
        "max_skew_deg": 3.0,
    },
    "Health": {
        "status": "ok",
        "version": "0.1.0",
        "uptime_s": 86400.5,
        "components": {
            name: {"status": "ok", "detail": "Works."}
            for name in ("robot", "camera", "station", "storage", "twin")
        },
    },
    "Job": _JOB,
    "JobEvents": {
        "items": [
            {
                "sequence": 1,
                "at": "2026-03-01T18:02:11.410Z",
                "kind": "phase_started",
                "phase": "preflight",
                "message": "Checking the robot and the charging station.",
                "data": {},
            }
        ],
        "next_cursor": None,
    },
    "JobPage": {"items": [_JOB], "next_cursor": None},
    "JobRequest": {"type": "charge", "vehicle_id": "zoe", "target_energy_wh": 12000},
    "JogStep": {"axis": "x", "distance_mm": 5.0, "speed_mm_s": 10.0},
    "Playback": {
        "duration_s": 62.4,
        "marks": [{"at_s": 0.0, "kind": "phase", "text": "locating"}],
    },
    "PlugConfirmation": {"state": "free"},
    "Reach": {
        axis: {"back_mm": 112.5, "on_mm": 207.0}
        for axis in ("x", "y", "insertion", "rho1", "rho2", "rho3")
    },
    "Robot": {
        "mode": "ready",
        "driver": "Simulator",
        "plug": "parked",
        "enabled": True,
        "homed": True,
        "measured": {"joints": _JOINTS, "tip": _TIP, "force_n": 0.0},
        "commanded": {"joints": _JOINTS, "tip": _TIP},
        "control": None,
        "fault": None,
        "socket": None,
        "updated_at": NOW,
    },
    "SimulatedBoardNow": {
        "held": {
            "type": "hold",
            "right": -0.5,
            "down": 0.0,
            "distance_mm": 380.0,
            "left_away_deg": 25.0,
            "top_away_deg": 0.0,
            "turn_deg": 0.0,
            "within_s": 0.7,
        }
    },
    "SimulatedCarNow": {
        "x_mm": 642.1,
        "y_mm": 318.7,
        "z_mm": 592.0,
        "speed_mm_s": 240.0,
        "moving": True,
    },
    "Station": {
        "name": "OpenEVSE",
        "online": True,
        "pilot": "C",
        "enabled": True,
        "held": False,
        "contactor_closed": True,
        "connector_locked": None,
        "power_w": 7340.2,
        "currents_a": [31.9, 0.0, 0.0],
        "session_energy_wh": 4210.5,
        "updated_at": NOW,
    },
    "Vehicle": _VEHICLE,
    "VehicleList": {"items": [_VEHICLE], "next_cursor": None},
    "VehicleSettings": _VEHICLE_SETTINGS,
    "Webhook": _WEBHOOK,
    "WebhookPage": {"items": [_WEBHOOK], "next_cursor": None},
    "WebhookSettings": _WEBHOOK_SETTINGS,
    "WebhookWithSecret": {**_WEBHOOK, "secret": "whsec_MfKQ9r8GKYqrTwjUPD8ILPZIo2LaLaSw"},
}
"""By the name of the schema."""

BODIES: dict[str, Json] = {
    "patchConfig": {"webhooks": {"timeout_s": 5}, "logging": {"level": "debug"}},
    "checkConfig": {"webhooks": {"timeout_s": 5}},
}
"""Of requests whose body has no schema of its own name, by operation."""

REQUESTS: dict[str, dict[str, Json]] = {
    **CALIBRATION_REQUESTS,
    "commandSimulatedBoard": {
        "hold": {
            "summary": "Hold the board at the left, its left edge tipped away",
            "value": {"type": "hold", "right": -0.6, "left_away_deg": 28},
        },
        "away": {"summary": "Take it away", "value": {"type": "away"}},
    },
    "commandSimulatedCar": {
        "drive_in": {
            "summary": "Come in, 20 cm beside the way, and stop at the place",
            "value": {"type": "drive_in", "right_mm": 200},
        },
        "drive_on": {
            "summary": "Go on 30 cm",
            "value": {"type": "drive_on", "forward_mm": 300},
        },
        "brake": {"summary": "Stop now", "value": {"type": "brake"}},
        "leave": {"summary": "Back out of the garage", "value": {"type": "leave"}},
    },
    "createJob": {
        "charge": {
            "summary": "Plug in, charge 12 kWh, unplug",
            "value": {"type": "charge", "vehicle_id": "zoe", "target_energy_wh": 12000},
        },
        "plug_in": {
            "summary": "Plug the only vehicle in and leave it so",
            "value": {"type": "plug_in"},
        },
        "unplug": {"summary": "Unplug", "value": {"type": "unplug"}},
    },
}
"""Operations with more than one example, by operation."""
