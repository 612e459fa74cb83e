from __future__ import annotations

import pytest
from pydantic import ValidationError

from drivers.simulator.parameters import BoardParameters, CarParameters, SimulationParameters


def test_a_misspelt_parameter_is_an_error() -> None:
    with pytest.raises(ValidationError, match="queue_capacitty"):
        BoardParameters.model_validate({"queue_capacitty": 3})


def test_parameters_survive_a_configuration_file() -> None:
    parameters = SimulationParameters.perfect()
    assert SimulationParameters.model_validate_json(parameters.model_dump_json()) == parameters


def test_telemetry_cannot_arrive_before_it_was_sampled() -> None:
    with pytest.raises(ValidationError, match="cannot come early"):
        BoardParameters(telemetry_delay_s=0.005, telemetry_jitter_s=0.006)


def test_ranges_must_be_in_order() -> None:
    with pytest.raises(ValidationError, match="face_z_mm"):
        CarParameters(face_z_mm=(250, 230))
    with pytest.raises(ValidationError, match="state_of_charge"):
        CarParameters(state_of_charge=(0.9, 0.1))
