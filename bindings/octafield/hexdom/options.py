"""Options of hex-dominant meshes. Defaults are those of the C++ struct."""

import math
from dataclasses import dataclass, fields
from typing import Any

from .. import _core
from ..errors import InvalidInput
from ..options import LARGEST_INT, integer_in, require_one_of

MESHES = ("none", "hex-dominant")  # that comparisons make along each field
CORRECTIONS = tuple(_core.HexDominantOptions.words["correction"])
POINTS = tuple(_core.HexDominantOptions.words["points"])
_DEFAULTS = _core.HexDominantOptions()


@dataclass(frozen=True, kw_only=True)
class HexMeshOptions:
    """Of the cells: edge_length wanted, input unit, or the number of cells wanted, which stands for cubes of the
    volume's part; 0 and 0: the mean edge of the surface. The rest: see octafield.volume.HexDominantOptions. Threads are
    those of FieldOptions.

    Raises InvalidInput.

        >>> from octafield.hexdom.options import HexMeshOptions
        >>> HexMeshOptions(edge_length=0.1).correction
        'axes'
    """

    edge_length: float = 0.0
    cells: int = 0
    correction: str = _DEFAULTS.correction
    points: str = _DEFAULTS.points
    refinements: int = _DEFAULTS.refinements
    most_tets: int = _DEFAULTS.most_tets
    most_hexahedra: int = _DEFAULTS.most_hexahedra
    min_scaled_jacobian: float = _DEFAULTS.min_scaled_jacobian
    hold_angle: float = _DEFAULTS.hold_angle
    recombine: bool = _DEFAULTS.recombine
    improve: bool = _DEFAULTS.improve

    def __post_init__(self) -> None:
        if not (math.isfinite(self.edge_length) and self.edge_length >= 0):
            raise InvalidInput(
                "the edge length of the cells must be positive and finite (0: default)", "option_out_of_range"
            )
        object.__setattr__(self, "cells", integer_in("cells", self.cells, 0, LARGEST_INT, " (0: default)"))
        if self.edge_length and self.cells:
            raise InvalidInput(
                "an edge length decides the number of cells: leave it or the number of cells out", "option_out_of_range"
            )
        require_one_of("correction", self.correction, CORRECTIONS)
        require_one_of("points", self.points, POINTS)
        integer_in("refinements", self.refinements, 0, 6)
        integer_in("most_tets", self.most_tets, 1, LARGEST_INT)
        integer_in("most_hexahedra", self.most_hexahedra, 1, LARGEST_INT)
        if not 0 < self.min_scaled_jacobian < 1:
            raise InvalidInput("the least scaled Jacobian must lie between 0 and 1", "option_out_of_range")
        if not 0 <= self.hold_angle <= math.pi / 2:
            raise InvalidInput("the hold angle must lie between 0 and 90 degrees", "option_out_of_range")
        for name in ("recombine", "improve"):
            if not isinstance(getattr(self, name), bool):
                raise InvalidInput(f"{name} must be true or false, not {getattr(self, name)!r}", "option_out_of_range")

    def of_cells(self) -> dict[str, Any]:
        """What octafield.volume.hex_dominant takes as it is here."""
        known = {option.name for option in fields(self)} - {"edge_length", "cells"}
        return {name: getattr(self, name) for name in sorted(known)}
