"""What a routine has found, number by number, whatever the routine was."""

from __future__ import annotations

from server.calibration.accuracy.verdict import judge_places
from server.calibration.grade import Grade
from server.calibration.routines.check_routine import CheckResult
from server.calibration.versions.new_calibration import NewCalibration
from server.schema.calibrations import (
    CalibrationKind,
    CameraValues,
    ForceValues,
    PlayValues,
    RobotValues,
    SocketValues,
    SwitchesValues,
)
from server.schema.routines import RoutineFigure


def figures_of(found: NewCalibration | CheckResult) -> list[RoutineFigure]:
    """The numbers that people want to see first."""
    if isinstance(found, CheckResult):
        return _of_check(found)
    return [*_of_values(found), *_misses(found)]


def verdict_of(
    found: NewCalibration | CheckResult | None,
) -> tuple[Grade | None, tuple[str, ...]]:
    """What that is worth, and what to mend."""
    if found is None:
        return None, ()
    if isinstance(found, CheckResult):
        return judge_places(found.places)
    return found.grade, found.remarks


def _of_values(found: NewCalibration) -> list[RoutineFigure]:
    values, sigma = found.values, found.evidence.sigma if found.evidence else {}
    if isinstance(values, CameraValues):
        camera = values.camera
        return [
            _figure("fx", "Focal length", camera.fx, sigma.get("fx"), "px"),
            _figure("cx", "Centre, across", camera.cx, sigma.get("cx"), "px"),
            _figure("cy", "Centre, down", camera.cy, sigma.get("cy"), "px"),
        ]
    if isinstance(values, RobotValues):
        built = values.mechanism
        return [
            _figure("left_leg_mm", "Left leg", built.left_leg_mm, sigma.get("left_leg_mm"), "mm"),
            _figure(
                "right_leg_mm", "Right leg", built.right_leg_mm, sigma.get("right_leg_mm"), "mm"
            ),
            _figure("left_scale", "Left belt", built.left_scale, sigma.get("left_scale"), ""),
            _figure("right_scale", "Right belt", built.right_scale, sigma.get("right_scale"), ""),
        ]
    if isinstance(values, SocketValues):
        socket = values.socket
        return [
            _figure("socket_x_mm", "Right of the label", socket.x_mm, None, "mm"),
            _figure("socket_y_mm", "Below the label", socket.y_mm, None, "mm"),
            _figure("socket_z_mm", "Behind the label", socket.z_mm, None, "mm"),
        ]
    if isinstance(values, SwitchesValues):
        return [
            _figure(
                "switch_left_mm", "Left switch", values.left_spread_mm, values.left_sigma_mm, "mm"
            ),
            _figure(
                "switch_right_mm", "Right switch", values.right_spread_mm, values.right_sigma_mm,
                "mm",
            ),
        ]  # fmt: skip
    if isinstance(values, PlayValues):
        return [
            _figure("play_left_mm", "Left play", values.left_mm, values.left_sigma_mm, "mm"),
            _figure("play_right_mm", "Right play", values.right_mm, values.right_sigma_mm, "mm"),
            _figure("lag_left_mm", "Left lag", values.left_following_mm, None, "mm"),
            _figure("lag_right_mm", "Right lag", values.right_following_mm, None, "mm"),
        ]
    return _of_force(values) if isinstance(values, ForceValues) else []


def _of_force(values: ForceValues) -> list[RoutineFigure]:
    figures = [
        _figure("friction_n", "Friction", values.friction_n, values.friction_sigma_n, "N"),
        _figure("offset_n", "Without force", values.offset_n, values.offset_sigma_n, "N"),
        _figure("lag_slide_mm", "Slide lag", values.following_mm, None, "mm"),
    ]
    if values.scale_sigma is not None:
        scale = _figure("force_scale", "Force scale", values.scale, values.scale_sigma, "")
        figures.append(scale)
    return figures


def _misses(found: NewCalibration) -> list[RoutineFigure]:
    unit = CalibrationKind(found.values.kind).unit
    figures = []
    if found.error is not None:
        figures.append(_figure("error", "Misses", found.error, None, unit))
    if found.error_in_use is not None:
        figures.append(_figure("error_in_use", "Missed before", found.error_in_use, None, unit))
    return figures


def _of_check(found: CheckResult) -> list[RoutineFigure]:
    places = found.places
    return [
        _figure("ap_mm", "Largest AP", max(one.accuracy_mm for one in places), None, "mm"),
        _figure("rp_mm", "Largest RP", max(one.repeatability_mm for one in places), None, "mm"),
        _figure(
            "vap_mm", "Largest vAP", max(one.direction_variation_mm for one in places), None, "mm"
        ),
    ]


def _figure(code: str, label: str, value: float, sigma: float | None, unit: str) -> RoutineFigure:
    return RoutineFigure(code=code, label=label, value=value, sigma=sigma, unit=unit)
