"""Options of quad meshes."""

import math
from dataclasses import dataclass

from ..errors import InvalidInput
from ..layout.options import INADMISSIBLE, MOST_QUADS
from ..options import integer_in, require_one_of

FOLLOW = ("default", "directions", "points")
FORMATS = ("vtu", "obj", "off", "msh", "mesh", "inp")


@dataclass(frozen=True, kw_only=True)
class QuadMeshOptions:
    """Of the quads: the number wanted, or their edge_length, input unit; 0 and 0: the mean edge of the triangles, or
    the sizes as they are. Sizes that are given are taken as ratios where a number or an edge length is told as well.

    keep_boundary: every segment of a plane region's outline is an edge of a quad.
    follow: of a field that is given: its "directions" and "points", the default; or "points" alone: quads are as square
        as can be round its singular points.
    inadmissible: what to do where the points are in places that no field has them in, as of QuadLayoutOptions.

    Raises InvalidInput.

        >>> from octafield.quad_mesh.options import QuadMeshOptions
        >>> QuadMeshOptions(quads=500).edge_length
        0.0
    """

    quads: int = 0
    edge_length: float = 0.0
    keep_boundary: bool = False
    follow: str = "default"
    inadmissible: str = "default"

    def __post_init__(self) -> None:
        object.__setattr__(self, "quads", integer_in("quads", self.quads, 0, MOST_QUADS, " (0: default)"))
        if not (math.isfinite(self.edge_length) and self.edge_length >= 0):
            raise InvalidInput(
                "the edge length of the quads must be positive and finite (0: default)", "option_out_of_range"
            )
        if self.edge_length and self.quads:
            raise InvalidInput(
                "an edge length decides the number of quads: leave it or the number of quads out", "option_out_of_range"
            )
        require_one_of("follow", self.follow, FOLLOW)
        require_one_of("inadmissible", self.inadmissible, INADMISSIBLE)
