"""The robot as it was built, beside the robot as it was drawn.

Everybody plans and measures with the drawn robot (`twin.geometry`). What the built one does
differently - other lengths, rails that are not parallel, belts that stretch - is one smooth map
between the joints of both, applied where commands leave for the motion board and where its
measurements come back. `planar` is the built mechanism, `correction` that map, `corrected_plan` a
whole motion seen through it.
"""

from twin.as_built.corrected_plan import CorrectedPlan
from twin.as_built.correction import JointCorrection
from twin.as_built.planar import PARAMETERS, PlanarAsBuilt

__all__ = ["PARAMETERS", "CorrectedPlan", "JointCorrection", "PlanarAsBuilt"]
