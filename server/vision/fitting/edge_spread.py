"""The shift of black/white edges towards white, as a smooth function of the place on the label.

Ink, blur and the tone curve move all edges of black areas outwards (or inwards). Where the light
is uneven (a reflection, a shadow) or the focus changes across the label, so does the shift. It
turns its sign with the polarity of the edge, which the pose does not: that is what tells the two
apart, and why the shift may have several unknowns of its own.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from server.vision.fitting.code_edges import CodeEdges
from server.vision.projection import Array

EDGES_FOR_SLOPE, EDGES_FOR_BOW = 100, 150
"""With fewer edges the additional unknowns would cost more than they give."""


@lru_cache(maxsize=8)
def spread_basis(edges: CodeEdges) -> Array:
    """Derivative of each edge's shift by the unknowns: 1; x, y; x^2, xy, y^2, shape (s, n).

    x and y run from -1 to 1 over the code.
    """
    x, y = (edges.points_mm / np.abs(edges.points_mm).max()).T
    columns = [np.ones_like(x)]
    if len(x) >= EDGES_FOR_SLOPE:
        columns += [x, y]
    if len(x) >= EDGES_FOR_BOW:
        columns += [x * x, x * y, y * y]
    basis = np.stack(columns)
    basis.flags.writeable = False  # it is shared through the cache
    return basis
