"""How each kind of camera is reached: configuration, not code."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated
from urllib.parse import quote, urlsplit, urlunsplit

from pydantic import BaseModel, ConfigDict, Field, SecretStr, field_validator

Rate = Annotated[float, Field(gt=0, le=240, allow_inf_nan=False)]
Exposure = Annotated[float, Field(gt=0, le=1.0, allow_inf_nan=False)]
Latency = Annotated[float, Field(ge=0, le=5.0, allow_inf_nan=False)]


class _Group(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid")


class V4l2Settings(_Group):
    """A USB camera (UVC) or any other that Linux knows."""

    device: str = Field("/dev/video0", min_length=1, description="Device, or its number")
    frames_per_s: Rate = 30.0
    fourcc: Annotated[str, Field(pattern=r"^[A-Z0-9 ]{4}$")] = Field(
        "MJPG", description="Pixel format; USB 2 has no room for large uncompressed pictures"
    )
    exposure_s: Exposure | None = Field(
        0.008, description="Fixed exposure; unset leaves it to the camera"
    )
    gain: float | None = Field(None, ge=0, description="Fixed gain in the camera's own units")
    focus: int | None = Field(
        None,
        ge=0,
        description="Fixed focus in the camera's own units; unset switches autofocus off",
    )


class PiCameraSettings(_Group):
    """The Raspberry Pi camera, through picamera2."""

    number: int = Field(0, ge=0, le=3, description="Which one, as `rpicam-hello --list-cameras`")
    frames_per_s: Rate = 30.0
    exposure_s: Exposure | None = Field(0.008, description="Fixed exposure; unset is automatic")
    gain: float | None = Field(2.0, ge=1.0, le=64.0, description="Fixed analogue gain")
    focus_m: Annotated[float, Field(gt=0.02, le=100)] | None = Field(
        None, description="Fixed focus distance, for cameras with a movable lens"
    )


class StreamSettings(_Group):
    """A network camera: RTSP, or HTTP with motion JPEG."""

    url: str = Field(
        "", pattern=r"^(|(rtsp|rtsps|http|https)://\S+)$", description="rtsp:// or http:// address"
    )
    user: str = Field("", max_length=200, description="As set in the camera, if it asks for one")
    password: SecretStr | None = Field(None, description="As set in the camera, if it asks for one")
    frames_per_s: Rate = 15.0
    latency_s: Latency = Field(0.2, description="From the exposure to the picture's arrival")

    @field_validator("url")
    @classmethod
    def _shows_no_password(cls, url: str) -> str:
        # The address is shown on the technician's page, in logs and in names.
        if "@" in urlsplit(url).netloc:
            raise ValueError("put who logs in into user and password, not into the address")
        return url

    @property
    def address(self) -> str:
        """The address with user and password, for the camera only."""
        parts = urlsplit(self.url)
        if not self.user:
            return self.url
        secret = "" if self.password is None else self.password.get_secret_value()
        login = f"{quote(self.user, safe='')}:{quote(secret, safe='')}"
        return urlunsplit(parts._replace(netloc=f"{login}@{parts.netloc}"))


class ReplaySettings(_Group):
    """Pictures from files in place of a camera."""

    path: Path = Field(Path("pictures"), description="Folder of pictures, or a video")
    frames_per_s: Rate = 10.0
    repeat: bool = Field(True, description="Begin again at the end")


class CameraLinks(_Group):
    """The settings of all kinds; the chosen driver uses its own."""

    v4l2: V4l2Settings = V4l2Settings()
    picamera: PiCameraSettings = PiCameraSettings()
    stream: StreamSettings = StreamSettings()
    replay: ReplaySettings = ReplaySettings()
