"""The model beside the robot: what it should measure, how sure that is, and where they part."""

from twin.divergence.findings import Change, Divergence, Quantity, Residual
from twin.divergence.numbers import DivergenceNumbers
from twin.divergence.samples import Entry, Sample, Sighting
from twin.divergence.watch import DivergenceWatch

__all__ = [
    "Change",
    "Divergence",
    "DivergenceNumbers",
    "DivergenceWatch",
    "Entry",
    "Quantity",
    "Residual",
    "Sample",
    "Sighting",
]
