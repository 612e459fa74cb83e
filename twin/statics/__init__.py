"""Statics of the robot: what its actuators carry and how far it sags."""

from twin.statics.actuators import (
    JointForces,
    TipForce,
    actuator_forces,
    alpha_actuator_forces,
    alpha_actuator_forces_many,
)
from twin.statics.along_plan import PlanForces, WorstForce, forces_along
from twin.statics.deflection import DEFAULT_TABLES, Sag, SagTables, SagValidity, sag
from twin.statics.limits import ActuatorLimits
from twin.statics.loads import LoadCase, Loads, actuator_loads, actuator_loads_many

__all__ = [
    "DEFAULT_TABLES",
    "ActuatorLimits",
    "JointForces",
    "LoadCase",
    "Loads",
    "PlanForces",
    "Sag",
    "SagTables",
    "SagValidity",
    "TipForce",
    "WorstForce",
    "actuator_forces",
    "actuator_loads",
    "actuator_loads_many",
    "alpha_actuator_forces",
    "alpha_actuator_forces_many",
    "forces_along",
    "sag",
]
