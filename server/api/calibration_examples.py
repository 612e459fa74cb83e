"""Examples of calibrations, for the OpenAPI document."""

from __future__ import annotations

from typing import Any

Json = Any

CALIBRATION_ID = "01957a40-1c3e-7f0a-9d52-6c1b7a90e4d2"

_ROBOT_VALUES: dict[str, Json] = {
    "kind": "robot",
    "mechanism": {
        "left_leg_mm": 533.21,
        "right_leg_mm": 530.87,
        "left_foot_x_mm": 55.0,
        "left_foot_y_mm": 0.0,
        "right_foot_x_mm": 1246.42,
        "right_foot_y_mm": -1.13,
        "left_rail_rad": 0.0021,
        "right_rail_rad": -0.0021,
        "left_scale": 1.0024,
        "right_scale": 0.9981,
    },
    "camera_rotation_rad": [0.013, -0.021, 3.127],
}
_CAMERA_VALUES: dict[str, Json] = {
    "kind": "camera",
    "camera": {
        "width": 1640,
        "height": 1232,
        "fx": 1296.4,
        "fy": 1296.1,
        "cx": 818.2,
        "cy": 617.9,
        "k1": 0.021,
        "k2": -0.034,
        "p1": 0.0,
        "p2": 0.0,
        "k3": 0.0,
    },
}
_CALIBRATION: dict[str, Json] = {
    "id": CALIBRATION_ID,
    "kind": "robot",
    "version": 3,
    "values": _ROBOT_VALUES,
    "grade": "good",
    "remarks": [],
    "error": 0.034,
    "error_in_use": 2.41,
    "made_at": "2026-03-01T18:04:05.120Z",
    "made_by": "Anna",
    "source": "25 looks at the label of Renault Zoe",
    "in_force": True,
}
_EVIDENCE: dict[str, Json] = {
    "looks": [
        {
            "rho1_mm": 212.4,
            "rho2_mm": 180.9,
            "label_mm": [12.1, -3.4, 291.0],
            "covariance_mm2": [0.0001, 0, 0, 0, 0.0001, 0, 0, 0, 0.0025],
            "residual_mm": [0.011, -0.004, 0.052],
            "weight": 1.0,
        }
    ],
    "sigma": {"left_leg_mm": 0.21},
    "unseen": [],
    "duration_s": 96.4,
    "tip_likely_mm": 0.07,
    "tip_at_most_mm": 0.14,
}

_ROUTINE: dict[str, Json] = {
    "kind": "robot",
    "state": "finished",
    "doing": "The calibration is done. Nobody uses it yet.",
    "done": 25,
    "total": 25,
    "looks": [{"x_mm": 642.0, "y_mm": 331.5, "seen": True}],
    "begun_by": "Anna",
    "begun_at": "2026-03-01T18:02:11.400Z",
    "calibration_id": CALIBRATION_ID,
    "check_id": None,
    "problem": None,
    "asks": None,
    "verdict": "good",
    "remarks": [],
    "figures": [
        {"code": "left_scale", "label": "Left belt", "value": 1.0024, "sigma": 0.0003, "unit": ""},
        {"code": "error", "label": "Misses", "value": 0.034, "sigma": None, "unit": "mm"},
    ],
}
_BELTS: dict[str, Json] = {
    "jobs": 100,
    "left_percent": 0.18,
    "left_sigma_percent": 0.025,
    "right_percent": 0.01,
    "right_sigma_percent": 0.025,
    "moved_mm": 0.22,
    "proven_mm": 0.12,
    "exceeds": True,
    "at_bound": False,
    "refused_in_a_row": 0,
}
_HINTS: list[Json] = [
    {
        "code": "plug_heavy",
        "title": "The plug goes in harder than it used to",
        "text": "At a depth of 36 mm the last 5 insertions took 88 N; 64 to 78 N were usual. Clean "
        "plug and socket, and look for bent contacts.",
        "vehicle_id": "zoe",
    }
]

CALIBRATION_MODELS: dict[str, Json] = {
    "AccuracyCheckPage": {
        "items": [
            {
                "id": "01957a44-5b10-7c1e-8a37-92d6f0b41c58",
                "made_at": "2026-03-01T18:09:40.000Z",
                "made_by": "Anna",
                "calibration_id": CALIBRATION_ID,
                "approaches": 3,
                "places": [
                    {
                        "x_mm": 650.0,
                        "y_mm": 335.0,
                        "accuracy_mm": 0.031,
                        "repeatability_mm": 0.094,
                        "direction_variation_mm": 0.058,
                        "attained_mm": [[649.97, 335.02], [650.03, 335.04]],
                    }
                ],
                "left_out": 0,
                "accuracy_mm": 0.031,
                "repeatability_mm": 0.094,
                "direction_variation_mm": 0.058,
                "duration_s": 141.2,
                "verdict": "good",
                "remarks": [],
            }
        ],
        "next_cursor": None,
    },
    "Activation": {"accept_worse": False},
    "Calibration": _CALIBRATION,
    "BoardLook": {
        "sequence": 57,
        "width_px": 1640,
        "height_px": 1232,
        "corners_px": [[412.3, 288.1], [501.7, 290.4], [413.0, 377.9]],
        "outline_px": [[412.3, 288.1], [501.7, 290.4], [413.0, 377.9]],
        "notice": "taken",
        "wish": {"place": "lower_right", "attitude": "left_away"},
        "taken": 7,
        "wanted": 18,
        "coverage": [
            [0, 2, 9, 12, 12, 8, 3, 0],
            [1, 6, 14, 17, 16, 12, 5, 1],
            [2, 8, 16, 20, 19, 14, 4, 0],
            [2, 7, 15, 19, 18, 11, 2, 0],
            [1, 5, 11, 14, 12, 6, 0, 0],
            [0, 2, 6, 8, 5, 1, 0, 0],
        ],
    },
    "CalibrationDetail": {**_CALIBRATION, "evidence": _EVIDENCE, "camera_evidence": None},
    "CalibrationEntry": {"values": _CAMERA_VALUES, "source": "camera-0003.toml"},
    "CalibrationPage": {"items": [_CALIBRATION], "next_cursor": None},
    "CalibrationNow": {
        "in_force": {
            "camera": None,
            "robot": _CALIBRATION,
            "sockets": [],
            "switches": None,
            "play": None,
            "force": None,
        },
        "routine": _ROUTINE,
        "drift": _BELTS,
        "hints": _HINTS,
    },
    "DriftReport": {
        "belts": _BELTS,
        "hints": _HINTS,
        "insertions": [
            {
                "vehicle_id": "zoe",
                "learnt_from": 8,
                "points": [[32.0, 39.1, 52.4], [36.0, 64.2, 78.0]],
                "recent": [[32.0, 60.3], [36.0, 88.1]],
            }
        ],
    },
    "RollBack": {"kind": "robot"},
    "Routine": _ROUTINE,
    "RoutineAnswer": {"code": "belts_left", "value": 300.7},
    "RoutineList": {
        "routines": [
            {
                "kind": "play",
                "title": "Play of the carriages",
                "what": "Brings each carriage to the same place from both sides.",
                "before": ["Let the plug hang freely at the robot."],
                "needs_label": True,
                "settings": [
                    {
                        "name": "approaches",
                        "label": "Approaches",
                        "unit": "",
                        "least": 3,
                        "most": 30,
                        "usual": 4,
                        "whole": True,
                    }
                ],
            }
        ]
    },
}
"""By the name of the schema."""

CALIBRATION_REQUESTS: dict[str, dict[str, Json]] = {
    "beginCalibration": {
        "camera": {
            "summary": "Calibrate the camera with the printed board",
            "value": {"kind": "camera", "square_mm": 24.05},
        },
        "robot": {
            "summary": "Measure the robot; both belts were measured with a rule",
            "value": {
                "kind": "robot",
                "vehicle_id": "zoe",
                "left_belt": {"commanded_mm": 300, "measured_mm": 300.7},
                "right_belt": {"commanded_mm": 300, "measured_mm": 299.4},
                "label_sigma_mm": 0.1,
            },
        },
        "check": {
            "summary": "Check the robot at nine places",
            "value": {"kind": "check", "vehicle_id": "zoe", "approaches": 3},
        },
        "switches": {
            "summary": "Home five times, and look where the robot then stands",
            "value": {"kind": "switches", "vehicle_id": "zoe", "approaches": 5},
        },
        "play": {
            "summary": "Approach one place from both sides",
            "value": {"kind": "play", "vehicle_id": "zoe", "approaches": 4},
        },
        "belts": {
            "summary": "Measure with a rule how far both carriages go",
            "value": {"kind": "belts", "distance_mm": 300, "reading_sigma_mm": 0.1},
        },
        "force": {
            "summary": "Friction of the slide, and its force scale by a spring",
            "value": {"kind": "force", "strokes": 3, "stroke_mm": 12, "spring_n_mm": 5.0},
        },
        "socket": {
            "summary": "Teach the socket that the plug is in",
            "value": {"kind": "socket", "vehicle_id": "zoe"},
        },
    },
}
"""Operations with more than one example, by operation."""
