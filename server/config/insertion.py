"""How the plug goes in and comes out."""

from __future__ import annotations

from pydantic import Field

from server.config.section import Section


class InsertionSettings(Section):
    """Distances, forces and what the camera must know before the plug touches the socket.

    The paper asks for a depth of 40 +-20 mm, 20 (+10) mm from plug to socket before the insertion
    and 70 +-10 N; its location accuracy of 0.5 mm is five times the sigma that is asked for here.
    """

    depth_mm: float = Field(40.0, ge=20, le=60, description="Depth of a plug that is fully in")
    depth_tolerance_mm: float = Field(
        1.0, gt=0, le=10, description="Depth that may be missing when the plug counts as in"
    )
    pre_insertion_distance_mm: float = Field(
        20.0, ge=5, le=30, description="From plug tip to socket face when the insertion begins"
    )
    force_limit_n: float = Field(79.0, gt=0, le=150, description="Never push harder")
    withdrawal_force_limit_n: float = Field(80.0, gt=0, le=150, description="Never pull harder")
    max_lateral_sigma_mm: float = Field(
        0.1, gt=0, le=1, description="Standard deviation of the socket's place, across the axis"
    )
    max_tilt_deg: float = Field(
        3.0, gt=0, le=10, description="Tilt of the socket that the plug holder can follow"
    )
    measurement_frames: int = Field(
        3, ge=1, le=20, description="Pictures that one measurement of the socket averages"
    )
    settle_s: float = Field(
        0.15, ge=0, le=5, description="Time the platform stands still before a measurement"
    )
