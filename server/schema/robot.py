"""The robot as the API shows it."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from server.control.model import HolderKind, PlugState, RobotMode
from server.schema.base import Timestamp, Wire


class Joints(Wire):
    """Actuator positions [mm]."""

    rho1_mm: float
    rho2_mm: float
    rho3_mm: float


class Tip(Wire):
    """Plug tip in the base frame: x along the rail, y up, z towards the car [mm]."""

    x_mm: float
    y_mm: float
    z_mm: float


class MeasuredMotion(Wire):
    """What the board measured."""

    joints: Joints
    tip: Tip | None = Field(description="Null while the robot is not homed")
    force_n: float = Field(description="Along the insertion axis, positive towards the car")


class CommandedMotion(Wire):
    """What the board was told."""

    joints: Joints
    tip: Tip | None


class ControlHolder(Wire):
    """Who has control of the robot."""

    kind: HolderKind
    name: str = Field(description="A person or a job, in words", examples=["Charging job"])
    since: Timestamp


class RobotFault(Wire):
    """Why the robot stands still, in words a person can act on."""

    code: str
    title: str
    detail: str
    remedy: str


class SocketEstimate(Wire):
    """The socket as last measured: entry point and axis in the base frame."""

    entry: Tip
    axis: tuple[float, float, float] = Field(description="Unit vector into the car")
    lateral_sigma_mm: float = Field(ge=0, description="Standard deviation across the axis")
    depth_sigma_mm: float = Field(ge=0, description="Standard deviation along the axis")
    measured_at: Timestamp


class Robot(Wire):
    """Everything about the robot that anyone may see."""

    mode: RobotMode
    driver: str = Field(examples=["Simulator"])
    plug: PlugState
    enabled: bool
    homed: bool
    measured: MeasuredMotion | None = Field(description="Null while offline")
    commanded: CommandedMotion | None
    control: ControlHolder | None
    fault: RobotFault | None
    socket: SocketEstimate | None
    updated_at: Timestamp = Field(description="When the newest telemetry sample was taken")


class JogStep(Wire):
    """One step of one joint or of the plug tip along one axis of the base frame."""

    axis: Literal["rho1", "rho2", "rho3", "x", "y", "insertion"]
    distance_mm: Annotated[float, Field(ge=-50, le=50, allow_inf_nan=False)]
    speed_mm_s: Annotated[float, Field(ge=0.5, le=20, allow_inf_nan=False)] = 10.0


class WayLeft(Wire):
    """How far an axis can still go [mm]; the plug's place may forbid it all the same."""

    back_mm: float = Field(ge=0, examples=[112.5])
    on_mm: float = Field(ge=0, examples=[207.0])


class Reach(Wire):
    """What is left of each axis before a joint limit, the workspace or a singularity."""

    x: WayLeft
    y: WayLeft
    insertion: WayLeft
    rho1: WayLeft
    rho2: WayLeft
    rho3: WayLeft


class PlugConfirmation(Wire):
    """A person has looked: the plug is out of the car, or in it."""

    state: Literal["free", "inserted"]
