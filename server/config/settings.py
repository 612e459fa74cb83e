"""The whole configuration: one section per subject."""

from __future__ import annotations

from typing import Literal, Self

from pydantic import Field, model_validator
from pydantic_settings import BaseSettings, PydanticBaseSettingsSource, SettingsConfigDict

from server.config.access import AccessSettings
from server.config.camera import CameraSettings
from server.config.charge_point import ChargePointSettings
from server.config.forces import force_conflict
from server.config.guidance import GuidanceSettings
from server.config.insertion import InsertionSettings
from server.config.jobs import JobSettings
from server.config.logs import LoggingSettings
from server.config.park import ParkSettings
from server.config.phase_times import PhaseTimeSettings
from server.config.push import PushSettings
from server.config.recordings import RecordingSettings
from server.config.robot import RobotSettings
from server.config.server import ServerSettings
from server.config.simulation import SimulationSettings
from server.config.station import StationSettings
from server.config.storage import StorageSettings
from server.config.supervision import SupervisionSettings
from server.config.tariff import TariffSettings
from server.config.tls import TlsSettings
from server.config.webhooks import WebhookSettings
from twin.divergence import DivergenceNumbers
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import PlatformPosition, UnreachableError, alpha, check_joint_limits
from twin.motion.limits import MotionLimits
from twin.statics import ActuatorLimits, Loads, SagTables


class Settings(BaseSettings):
    """Everything that can be set, with defaults that work on the simulator.

    Making one directly takes the defaults and what is given, and nothing from the machine: files
    and environment variables are the business of `server.config.loading`.
    """

    model_config = SettingsConfigDict(
        frozen=True,
        extra="forbid",
        env_prefix="PLUGPILOT_",
        env_nested_delimiter="__",
    )

    server: ServerSettings = ServerSettings()
    access: AccessSettings = AccessSettings()
    tls: TlsSettings = TlsSettings()
    storage: StorageSettings = StorageSettings()
    robot: RobotSettings = RobotSettings()
    geometry: RobotGeometry = RobotGeometry()
    motion: MotionLimits = MotionLimits()
    divergence: DivergenceNumbers = DivergenceNumbers()
    loads: Loads = Loads()
    actuators: ActuatorLimits = ActuatorLimits()
    sag: SagTables = SagTables()
    camera: CameraSettings = Field(default_factory=CameraSettings)
    station: StationSettings = StationSettings()
    insertion: InsertionSettings = InsertionSettings()
    supervision: SupervisionSettings = SupervisionSettings()
    park: ParkSettings = ParkSettings()
    guidance: GuidanceSettings = GuidanceSettings()
    jobs: JobSettings = JobSettings()
    phase_times: PhaseTimeSettings = PhaseTimeSettings()
    recordings: RecordingSettings = RecordingSettings()
    tariff: TariffSettings = TariffSettings()
    charge_point: ChargePointSettings = ChargePointSettings()
    webhooks: WebhookSettings = WebhookSettings()
    push: PushSettings = PushSettings()
    simulation: SimulationSettings = SimulationSettings()
    logging: LoggingSettings = LoggingSettings()

    @property
    def simulated(self) -> bool:
        """No real robot moves."""
        return "robot" in self.simulated_parts

    @property
    def simulated_parts(self) -> list[Literal["robot", "camera", "station"]]:
        """What is not real. Around a real robot the other parts follow what it reports."""
        parts: list[Literal["robot", "camera", "station"]] = ["robot", "camera", "station"]
        return [part for part in parts if getattr(self, part).driver == "simulator"]

    @property
    def clock_speed(self) -> float:
        """Seconds of the event loop per second of the wall clock: a real robot has no choice."""
        return self.simulation.speed if self.simulated else 1.0

    @classmethod
    def settings_customise_sources(
        cls,
        settings_cls: type[BaseSettings],
        init_settings: PydanticBaseSettingsSource,
        env_settings: PydanticBaseSettingsSource,
        dotenv_settings: PydanticBaseSettingsSource,
        file_secret_settings: PydanticBaseSettingsSource,
    ) -> tuple[PydanticBaseSettingsSource, ...]:
        """Only what is given: see the description of the class."""
        del settings_cls, env_settings, dotenv_settings, file_secret_settings
        return (init_settings,)

    @model_validator(mode="after")
    def _slide_is_long_enough(self) -> Self:
        slide = self.geometry.rho3
        needed = self.insertion.pre_insertion_distance_mm + self.insertion.depth_mm
        if needed > slide.stroke_mm:
            msg = (
                f"the slide is too short: insertion.pre_insertion_distance_mm + insertion.depth_mm"
                f" = {needed:g} mm, but geometry.rho3 travels only {slide.stroke_mm:g} mm"
            )
            raise ValueError(msg)
        return self

    @model_validator(mode="after")
    def _forces_agree(self) -> Self:
        motor_n = self.simulation.parameters.drives.max_force_n
        conflict = force_conflict(
            geometry=self.geometry,
            loads=self.loads,
            insertion=self.insertion,
            strongest_n=self.actuators.rho3_n,
            slide=self.robot.board.slide,
            simulated_motor_n=motor_n if self.simulated else None,
        )
        if conflict is not None:
            raise ValueError(conflict)
        return self

    @model_validator(mode="after")
    def _park_position_is_reachable(self) -> Self:
        park = self.park
        try:
            carriages = alpha.inverse(self.geometry, PlatformPosition(park.x_mm, park.y_mm))
            check_joint_limits(self.geometry, JointPosition(*carriages, park.rho3_mm))
        except UnreachableError as error:
            msg = f"the robot cannot reach [park]: {error}"
            raise ValueError(msg) from error
        return self
