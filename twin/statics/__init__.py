"""Statics of the robot: what its actuators carry and how far it sags."""

from twin.statics.actuators import JointForces, TipForce, actuator_forces, alpha_actuator_forces
from twin.statics.deflection import Sag, SagTables, sag

__all__ = [
    "JointForces",
    "Sag",
    "SagTables",
    "TipForce",
    "actuator_forces",
    "alpha_actuator_forces",
    "sag",
]
