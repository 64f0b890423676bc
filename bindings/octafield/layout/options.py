"""Options of quad layouts. Defaults are those of the C++ structs."""

import math
from dataclasses import dataclass

from .. import _core
from ..errors import InvalidInput
from ..options import AXES, integer_in, require_one_of

INADMISSIBLE = ("default", *_core.ImposedFieldOptions.words["inadmissible"])
LAYOUTS = ("t-mesh", "separatrices")
MOST_QUADS = 10_000_000
BLOCKS = tuple(_core.QuantizedQuadsOptions.words["blocks"])
MEASURES = tuple(_core.QuantizedQuadsOptions.words["measure"])
_FIELD, _CURVES, _QUADS = _core.ImposedFieldOptions(), _core.LayoutCurveOptions(), _core.QuantizedQuadsOptions()


@dataclass(frozen=True, kw_only=True)
class QuadLayoutOptions:
    """Of the quads: the number wanted, or their edge_length, input unit; 0 and 0: the mean edge of the triangles.

    layout: "t-mesh": separatrices stop at one another, whole numbers put the T-joints on vertices of the quads
        (octafield.surface.motorcycle_graph, quantized_quads); features are followed with points of a computed field. Or
        "separatrices": all of them to their ends (quad_layout, layout_quads). blocks, of t-meshes: "few", as
        long as quads stay good; or "fine": quads nearer to the lengths, in blocks that may be as small as they are.
        measure, of t-meshes: quads are spread by "parameters", as large as the field has them, or by "lengths", about
        as large as one another.
    axes: of quads: "orthogonal", at right angles as far as the points allow; or "free": along two lines at any angle on
        faces with corners that right angles do not fit, so that both sides of these are followed (octafield.surface.
        non_orthogonal_field, lines_metric); points and quads at corners are those lines' there.
    inadmissible: what to do where the points are in places that no field has them in (octafield.surface.
        impose_singular_points): "fail", "move" them, "rotate" the field; "default": move points of a computed field,
        fail with points that were given.
    tolerance: radians, by which such a condition may be missed. end_tolerance, max_length: of separatrices, in quad
        coordinates, 0: default (octafield.surface.layout_curves).

    Raises InvalidInput.

        >>> from octafield.layout.options import QuadLayoutOptions
        >>> QuadLayoutOptions(quads=500).inadmissible
        'default'
    """

    quads: int = 0
    edge_length: float = 0.0
    layout: str = "t-mesh"
    blocks: str = _QUADS.blocks
    measure: str = _QUADS.measure
    axes: str = "orthogonal"
    inadmissible: str = "default"
    tolerance: float = _FIELD.tolerance
    end_tolerance: float = _CURVES.end_tolerance
    max_length: float = _CURVES.max_length

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
        require_one_of("layout", self.layout, LAYOUTS)
        require_one_of("blocks", self.blocks, BLOCKS)
        require_one_of("measure", self.measure, MEASURES)
        require_one_of("axes", self.axes, AXES)
        require_one_of("inadmissible", self.inadmissible, INADMISSIBLE)
        if not 0 < self.tolerance <= math.pi / 4:
            raise InvalidInput("the tolerance of conditions must lie between 0 and 45 degrees", "option_out_of_range")
        for name in ("end_tolerance", "max_length"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value >= 0):
                raise InvalidInput(
                    f"{name.replace('_', ' ')} must be positive and finite (0: default)", "option_out_of_range"
                )
