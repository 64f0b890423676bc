"""From a file to triangles of wanted sizes: read, repair, features, lengths, triangles, figures.

result = compute_remesh("scan.stl", MeshOptions(repair="fill"), remeshing=RemeshingOptions(vertices=20000))
result.mesh                     # octafield.TriangleMesh
result.record.quality.min       # of the worst triangle
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .. import _core
from .._core import CloseRemeshResult, FeatureGraph, TriangleMesh
from ..domain.inputs import Input, naming
from ..domain.mesh_writers import write_mesh
from ..domain.meshing import SoundInput, Source, read_sound
from ..errors import InvalidInput
from ..hexdom.sizes import Sizes
from ..meshes.registry import find_mesh_format, written_suffixes
from ..options import MeshOptions
from ..progress.phases import PeakMemory, Progress, announce
from ..quad_mesh.sized import size_at
from .options import DEVIATION, RemeshingOptions

if TYPE_CHECKING:
    from ..records.remesh import RemeshRecord

_PARTS = 60  # of the diagonal: between places where sizes are asked for
_MOST = 400_000  # triangles for that


@dataclass(repr=False, kw_only=True)
class RemeshedSurface:
    """A new mesh of a surface.

    mesh: its triangles. features: of it, pieces of the input's curves. qualities: (t,) of the triangles, in [0, 1]
    (octafield.surface.triangle_qualities). record: all figures, the JSON object of the command line."""

    mesh: TriangleMesh
    features: FeatureGraph
    qualities: np.ndarray
    record: RemeshRecord

    def __repr__(self) -> str:
        r = self.record
        return (
            f"RemeshedSurface({r.input}: {r.triangles:,} triangles; least quality {r.quality.min:.3f}, deviation"
            f" {max(r.deviation.of_input, r.deviation.of_mesh):.2g} of the diagonal)"
        )

    def write(self, path: str | Path) -> list[str]:
        """The triangles, with the feature edges where the format holds them, by the path's suffix (also .gz): complete
        or not at all. Gives what the format could not hold, in sentences."""
        edges = np.asarray(self.features.edges)
        found = Input(self.record.input, self.mesh, lines=edges if len(edges) else None, creases=bool(len(edges)))
        return write_mesh(path, found)


def compute_remesh(
    source: Source,
    options: MeshOptions = MeshOptions(),
    progress: Progress | None = None,
    *,
    remeshing: RemeshingOptions = RemeshingOptions(),
    sizes: Sizes | None = None,
) -> RemeshedSurface:
    """Triangles of wanted sizes on a surface, open or closed, or on the boundary of a tet mesh. Its feature edges and
    corners are kept, its topology too; every vertex lies on it.

    options: of reading, repair and features; what they say of lengths, interfaces and splitting is not used. Repair
    from level "fill" on fills holes; below that an open surface keeps its rims. sizes: edge lengths wanted, as
    compute_quad_mesh takes them. progress(phase, fraction, merit): False cancels.
    Raises InvalidInput, GeometryError, IoError, Cancelled.

        >>> import octafield
        >>> from octafield.domain.generators import generate
        >>> result = octafield.compute_remesh(generate("ball"), remeshing=octafield.RemeshingOptions(vertices=500))
        >>> result.record.watertight, result.record.quality.min > 0.3, abs(result.record.vertices - 500) < 25
        (True, True, True)
    """
    from .record import of_remesh

    if options.edge_length or options.max_cells:
        raise InvalidInput("lengths are told by the options of remeshing, not those of the mesh", "ignored_option")
    if sizes is not None and (remeshing.edge_length or remeshing.curvature):
        raise InvalidInput("sizes decide on the lengths: leave the edge length and curvature out", "ignored_option")
    memory = PeakMemory()
    wanted = replace(options, interfaces=False, split=False)
    sound = read_sound(source, wanted, volume=False, fills=True, progress=progress)
    with naming(sound.found.name):
        surface = sound.found.surface if sound.sheets is None else sound.sheets.mesh
        with sound.clock.phase("remesh"):
            announce(progress, "remesh")
            made = _made(sound, surface, remeshing, sizes, progress)
        with sound.clock.phase("judge"):
            announce(progress, "judge")
            record = of_remesh(sound, surface, made, remeshing, options, memory)
    return RemeshedSurface(
        mesh=made.mesh, features=made.features, qualities=np.asarray(_core.triangle_qualities(made.mesh)), record=record
    )


def require_surface_format(path: str | Path) -> None:
    """Raises IoError, InvalidInput unless surfaces are written to such files, so that it is known before the work."""
    form = find_mesh_format(path, to_write=True)
    if "triangles" not in form.holds:
        raise InvalidInput(
            f"{path}: {form.suffix_of(path)} files hold tets; write one of {' '.join(written_suffixes(surfaces=True))}",
            "not_tets",
        )


def _made(
    sound: SoundInput, surface: TriangleMesh, wanted: RemeshingOptions, sizes: Sizes | None, progress: Progress | None
) -> CloseRemeshResult:
    features, deviation = sound.features, wanted.deviation
    remesh = partial(
        _core.close_remesh,
        vertices=wanted.vertices,
        quality=wanted.quality,
        progress=progress,
        keep_stubs=sound.feature_source != "angle",
    )
    if sizes is not None:
        surface, features = _refined(surface, features)
        lengths = size_at(sizes, sound.found)(np.asarray(surface.vertices))
    elif wanted.curvature:
        field = _core.size_field(surface, features, max_cells=1e9)
        lengths = np.asarray(field.lengths)
    else:
        length = wanted.edge_length or float(_core.default_edge_length(surface))
        lengths = np.full(len(surface.vertices), length)
        if not (wanted.edge_length or wanted.vertices or deviation):
            deviation = DEVIATION
    return remesh(surface, features, lengths, deviation=deviation * _core.bounding_box_diagonal(surface.vertices))


def _refined(surface: TriangleMesh, features: FeatureGraph) -> tuple[TriangleMesh, FeatureGraph]:
    """Each triangle as four until sides are short, so that sizes between vertices are seen, too."""
    points, triangles = np.asarray(surface.vertices), np.asarray(surface.triangles).astype(np.int64)
    edges = np.asarray(features.edges).astype(np.int64).reshape(-1, 2)
    shortest = _core.bounding_box_diagonal(surface.vertices) / _PARTS
    while 4 * len(triangles) <= _MOST:
        sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
        unique, place = np.unique(sides, axis=0, return_inverse=True)
        if np.linalg.norm(points[unique[:, 0]] - points[unique[:, 1]], axis=1).max() <= shortest:
            break
        a, b, c = triangles.T
        ab, bc, ca = (len(points) + place.reshape(-1, 3)).T
        keys = unique[:, 0] * len(points) + unique[:, 1]
        low, high = np.sort(edges, axis=1).T
        middle = len(points) + np.searchsorted(keys, low * len(points) + high)
        edges = np.concatenate([np.column_stack([low, middle]), np.column_stack([middle, high])])
        points = np.concatenate([points, points[unique].mean(axis=1)])
        triangles = np.concatenate(
            [np.column_stack(part) for part in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))]
        )
    mesh = TriangleMesh(points, triangles.astype(np.int32))
    return mesh, FeatureGraph(edges.astype(np.int32), list(features.corners))
