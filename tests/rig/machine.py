"""The motors, screws and switches that hang on the board in the rig."""

from __future__ import annotations

from dataclasses import dataclass

from drivers.arduino.settings import BoardSettings
from tests.rig.truth import TrueState
from twin.geometry import RobotGeometry
from twin.joints import JointPosition

EDGES_PER_COUNT = 2
"""The firmware counts two of the four edges of an encoder period."""

RESERVE_MM = 2.0
"""The mechanical stops are this far behind the switches and the ends of the travel."""

STANDING = JointPosition(30.0, 260.0, 53.0)
"""Where the robot stands at power-up unless a test says otherwise: away from every switch."""

DEFAULTS = BoardSettings()
BRISK = {"seek_speed_mm_s": 70.0, "locate_speed_mm_s": 5.0, "homing_acceleration_mm_s2": 1000.0}
TUNED = BoardSettings(
    rho1=DEFAULTS.rho1.model_copy(update=BRISK), rho2=DEFAULTS.rho2.model_copy(update=BRISK)
)
"""The defaults, but homing in a third of the time."""


@dataclass(frozen=True, slots=True)
class Machine:
    """The true machine; the host's settings are to fit it.

    Attributes:
        geometry: Gives the travel.
        settings: Give the scales and the directions, as a calibration would have found them.
        start: Where the joints truly stand at power-up.
        slide_friction_n: Dry friction of motor and screw.
        slide_force_per_pwm_n: Of the blocked motor.
        slide_back_emf_pwm_s_per_mm: PWM that a speed takes.
        slide_time_constant_s: Of the unloaded speed.
    """

    geometry: RobotGeometry
    settings: BoardSettings
    start: JointPosition
    slide_friction_n: float = 7.5
    slide_force_per_pwm_n: float = 1 / 1.6
    slide_back_emf_pwm_s_per_mm: float = 110.0 * 93.0 / 1000.0
    slide_time_constant_s: float = 0.05

    def options(self) -> dict[str, float]:
        """The simulator's command-line options."""
        options: dict[str, float] = {}
        for name, axis, travel, start_mm in zip(
            ("rho1", "rho2"),
            (self.settings.rho1, self.settings.rho2),
            (self.geometry.rho1, self.geometry.rho2),
            self.start,
            strict=False,
        ):
            per_mm = axis.units_per_mm
            switch_mm = travel.min_mm - axis.switch_below_travel_mm
            options |= {
                f"{name}.start": start_mm * per_mm,
                f"{name}.lowest": (switch_mm - RESERVE_MM) * per_mm,
                f"{name}.highest": (travel.max_mm + RESERVE_MM) * per_mm,
                f"{name}.switch_at": switch_mm * per_mm,
                f"{name}.reversed": float(axis.reversed),
            }
        slide, travel = self.settings.rho3, self.geometry.rho3
        switch_mm = travel.min_mm - slide.switch_below_travel_mm
        return options | {
            "rho3.start_mm": self.start.rho3_mm,
            "rho3.lowest_mm": switch_mm - RESERVE_MM,
            "rho3.highest_mm": travel.max_mm + RESERVE_MM,
            "rho3.switch_at_mm": switch_mm,
            "rho3.edges_per_mm": EDGES_PER_COUNT * slide.units_per_mm,
            "rho3.force_per_pwm_n": self.slide_force_per_pwm_n,
            "rho3.back_emf_pwm_s_per_mm": self.slide_back_emf_pwm_s_per_mm,
            "rho3.friction_n": self.slide_friction_n,
            "rho3.time_constant_s": self.slide_time_constant_s,
        }


def true_joints(machine: Machine, state: TrueState) -> JointPosition:
    """Carriages and slide in the coordinates of the true machine."""
    settings = machine.settings
    return JointPosition(
        state.rho1_steps / settings.rho1.units_per_mm,
        state.rho2_steps / settings.rho2.units_per_mm,
        state.rho3_mm,
    )


def standing_machine(start: JointPosition = STANDING) -> Machine:
    """The machine of the default geometry."""
    return Machine(RobotGeometry(), TUNED, start)
