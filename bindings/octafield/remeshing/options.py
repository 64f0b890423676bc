"""Options of remeshing for its own sake."""

import math
from dataclasses import dataclass

from ..errors import InvalidInput
from ..options import integer_in

MOST_VERTICES = 20_000_000
DEVIATION = 1e-3  # of the diagonal, where nothing else is asked for


@dataclass(frozen=True, kw_only=True)
class RemeshingOptions:
    """Of the triangles: their edge_length, input unit; or how many vertices; or curvature: edges by which the surface
    turns by 12 degrees at most, with walls and gaps looked at (octafield.surface.size_field). With vertices, the
    lengths of curvature, or sizes that are given, are taken as ratios. Nothing of these: lengths that keep the new
    surface within `deviation` of the input.

    deviation: over the diagonal of the input's box, between the surfaces, both ways: edges become shorter where it is
        exceeded. 0: 0.001 where nothing else decides on the lengths; else none.
    quality: that every triangle is to have (octafield.surface.triangle_qualities), 0 to 0.5.

    Raises InvalidInput.

        >>> from octafield.remeshing.options import RemeshingOptions
        >>> RemeshingOptions(vertices=5000).quality
        0.3
    """

    edge_length: float = 0.0
    vertices: int = 0
    curvature: bool = False
    deviation: float = 0.0
    quality: float = 0.3

    def __post_init__(self) -> None:
        object.__setattr__(self, "vertices", integer_in("vertices", self.vertices, 0, MOST_VERTICES, " (0: default)"))
        for name in ("edge_length", "deviation"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value >= 0):
                raise InvalidInput(
                    f"the {name.replace('_', ' ')} must be positive and finite (0: default)", "option_out_of_range"
                )
        if not 0 <= self.quality <= 0.5:
            raise InvalidInput("the quality must lie between 0 and 0.5", "option_out_of_range")
        if self.edge_length and (self.vertices or self.curvature):
            raise InvalidInput(
                "an edge length decides how many vertices there are and where: leave it out, or vertices and curvature",
                "option_out_of_range",
            )
