"""The camera as a technician sees it: one picture, the label found in it, and its health."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from server.schema.base import Timestamp, Wire
from server.schema.problem import Problem

Pixel = tuple[float, float]
"""A place in the picture [px of the camera model], pixel centres at integers."""

Triple = tuple[float, float, float]


class PixelEllipse(Wire):
    """One standard deviation of a place in the picture."""

    major_px: float = Field(ge=0, description="Long half axis; times 2.4477 it holds 95 %")
    minor_px: float = Field(ge=0, description="Short half axis")
    angle_rad: float = Field(description="From the picture's x axis to the long axis, towards y")


class FittedPose(Wire):
    """The pose of the label, as the camera sees it, and how good it is."""

    source: Literal["edges", "corners"] = Field(
        description="All module edges; or, too coarse to move by, the four corners"
    )
    position_mm: Triple = Field(description="Label centre in the camera frame: right, down, ahead")
    position_sigma_mm: Triple = Field(description="Standard deviations of the position")
    turn_deg: Triple = Field(description="Rotation vector of T_camera_label")
    turn_sigma_deg: Triple = Field(description="Standard deviations about the camera's axes")
    axes_px: tuple[Pixel, Pixel, Pixel] = Field(
        description="From the centre: the label's right, its bottom, and out of the car; half a "
        "label long"
    )
    ellipse: PixelEllipse = Field(description="Uncertainty of the label's centre in the picture")
    residual_px: float = Field(ge=0, description="Root mean square distance of edges and model")
    inlier_share: float = Field(ge=0, le=1, description="Measured edges that agree with the model")
    measurements: int = Field(ge=0, description="Edges measured; 4 for corners")


class SeenLabel(Wire):
    """A label that was read in the picture."""

    payload: str
    vehicle_id: str | None = Field(description="Whose label it is; null if nobody's")
    outline_px: list[Pixel] = Field(description="Its border, in order, as the lens bends it")
    centre_px: Pixel
    pose: FittedPose | None = Field(description="Null when its size is unknown or nothing fits")


class CameraInspection(Wire):
    """One picture of the camera, looked at closely."""

    sequence: int = Field(ge=1, description="Grows; names the picture")
    taken_at: Timestamp = Field(description="Middle of the exposure")
    width_px: int = Field(ge=1, description="Of the camera; the picture itself may be sent smaller")
    height_px: int = Field(ge=1)
    age_s: float = Field(ge=0, description="From the middle of the exposure to the end of the look")
    frames_per_s: float | None = Field(description="Of the sensor; null after the first picture")
    exposure_ms: float | None = Field(description="Null when the camera does not tell")
    brightness: float = Field(ge=0, le=255, description="Mean grey value")
    dark_share: float = Field(ge=0, le=1, description="Pixels without any light")
    bright_share: float = Field(ge=0, le=1, description="Pixels that are clipped")
    label: SeenLabel | None
    trouble: Problem | None = Field(
        description="Why there is no label, or no pose that deserves trust"
    )
