"""The closed loop of rho3 with the gains of the settings, on a simulated motor and screw."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields

import pytest

from drivers.arduino.configuration import configuration_messages
from drivers.arduino.protocol.messages import Fault, State
from drivers.arduino.scale import AxisScale
from drivers.arduino.settings import BoardSettings, SlideSettings
from drivers.arduino.steps import Triple, segment_end, wire_segment
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.motion import MotionLimits, plan_joint_move, plan_segments

Run = Callable[[str, list[str]], list[str]]

SETTINGS = BoardSettings()
SLIDE = SETTINGS.slide
PER_MM = SETTINGS.rho3.units_per_mm
HOME = JointPosition(150.0, 150.0, 50.0)
OUT_MM = (70.0,)
OUT_AND_BACK_MM = (70.0, 62.0, 70.0)
REST_MS = 1500
QUIET_MS = 500


@dataclass(frozen=True, slots=True)
class Screw:
    """Motor and screw; the settings of the host are made for these numbers."""

    counts_per_mm: float = PER_MM
    friction_n: float = 7.5
    force_per_pwm_n: float = 1 / SLIDE.pwm_per_newton
    back_emf_pwm_s_per_mm: float = SLIDE.back_emf_pwm_per_count_ms * PER_MM / 1000
    time_constant_s: float = 0.05
    load_from_mm: float = 60.0
    load_n: float = 0.0


@dataclass(frozen=True, slots=True)
class Sample:
    """One millisecond; places in counts."""

    state: State
    fault: Fault
    set_point: int
    measured: int
    true: float
    pwm: int
    force_dn: int


def slide_along(
    run: Run, slide: SlideSettings, screw: Screw, targets_mm: tuple[float, ...]
) -> list[Sample]:
    """Home, follow a plan from target to target, then rest."""
    settings = BoardSettings(slide=slide)
    configuration = configuration_messages(settings, RobotGeometry(), MotionLimits())
    scales = [AxisScale(axis.units_per_mm) for axis in settings.axes]
    one, two, three = ((s.units(q) << 31) + (1 << 30) for s, q in zip(scales, HOME, strict=True))
    end: Triple = (one, two, three)
    lines = [
        b"".join(part.pack() for part in configuration).hex(),
        " ".join(f"{getattr(screw, field.name):.9g}" for field in fields(screw)),
        str(REST_MS),
    ]
    here = HOME
    for target_mm in targets_mm:
        target = HOME._replace(rho3_mm=target_mm)
        for segment in plan_segments(plan_joint_move(MotionLimits(), here, target)):
            wired = wire_segment(segment, len(lines) - 3, end, scales)
            lines.append(wired.pack().hex())
            end = segment_end(wired).position
        here = target
    return [_sample(line) for line in run("slide", lines)]


def _sample(line: str) -> Sample:
    state, fault, set_point, measured, true, pwm, force_dn = line.split()
    return Sample(
        State(int(state)), Fault(int(fault)), int(set_point), int(measured), float(true),
        int(pwm), int(force_dn),
    )  # fmt: skip


def at_rest(samples: list[Sample]) -> list[Sample]:
    """Those after the board said READY for the last time."""
    first = max(i for i, sample in enumerate(samples) if sample.state is not State.READY) + 1
    return samples[first:]


SCREWS = {
    "as configured": Screw(),
    "insertion with 40 N": Screw(load_n=40.0),
    "insertion with 70 N": Screw(load_n=70.0),
    "50 N and twice the friction": Screw(load_n=50.0, friction_n=15.0),
    "little friction": Screw(friction_n=3.0),
    "twice the friction": Screw(friction_n=15.0),
    "stronger motor": Screw(force_per_pwm_n=0.8),
    "weaker motor": Screw(force_per_pwm_n=0.5),
    "nimble": Screw(time_constant_s=0.03),
    "sluggish, with 70 N": Screw(time_constant_s=0.08, friction_n=4.0, load_n=70.0),
    "another speed voltage": Screw(back_emf_pwm_s_per_mm=8.5),
}


@pytest.mark.parametrize("targets_mm", [OUT_MM, OUT_AND_BACK_MM], ids=["out", "out and back"])
@pytest.mark.parametrize("screw", SCREWS.values(), ids=SCREWS.keys())
def test_the_slide_arrives_and_stays(run: Run, screw: Screw, targets_mm: tuple[float, ...]) -> None:
    samples = slide_along(run, SLIDE, screw, targets_mm)
    assert {sample.fault for sample in samples} == {Fault.NONE}
    rest = at_rest(samples)
    # it arrives soon after its set point
    settling_ms = (
        len(samples)
        - len(rest)
        - 1
        - max(i for i, sample in enumerate(samples) if sample.set_point != samples[-1].set_point)
    )
    assert settling_ms < 500
    off_mm = [abs(s.true - s.set_point - 0.5) / PER_MM for s in rest]
    assert off_mm[0] < 0.03
    assert off_mm[-1] < 0.04
    # and neither swings nor hunts: in the end nothing moves, and nothing tries to
    assert len({(sample.true, sample.pwm) for sample in rest[-QUIET_MS:]}) == 1
    worst_mm = max(abs(s.set_point - s.measured) for s in samples) / PER_MM
    assert worst_mm < 0.7 * SLIDE.following_error_mm


def test_a_slide_that_is_too_weak_for_its_load_ends_in_a_named_fault(run: Run) -> None:
    weak = SLIDE.model_copy(update={"ki_pwm_per_count_s": 5.0, "integral_pwm_max": 60})
    samples = slide_along(run, weak, Screw(load_n=70.0), OUT_MM)
    assert samples[-1].fault in {Fault.FOLLOWING_ERROR, Fault.STALL}
    assert samples[-1].state is State.FAULT


def test_a_slide_that_stops_a_little_short_rests_there(run: Run) -> None:
    without = SLIDE.model_copy(update={"ki_pwm_per_count_s": 0.0})
    samples = slide_along(run, without, Screw(friction_n=16.0), OUT_MM)
    assert samples[-1].fault is Fault.NONE
    assert samples[-1].state is State.READY
    short_mm = (samples[-1].set_point - samples[-1].measured) / PER_MM
    assert SLIDE.settled_mm < abs(short_mm) <= SLIDE.near_mm
