"""From a file to an atlas of its surface: read, features, charts, figures.

result = compute_atlas("part.stl", atlas_options=AtlasOptions(conformity=0.2))
result.atlas.uv         # of the corners that result.atlas.uv_triangles names
result.record.charts    # the figures
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .. import _core
from .._core import Atlas, AtlasOptions, SurfaceDomain
from ..domain.inputs import naming
from ..domain.meshed_input import MeshedInput
from ..domain.meshing import Source, prepare_mesh
from ..options import MeshOptions
from ..progress.phases import PeakMemory, PhaseClock, Progress, forward
from ..view.notebook import Facts, ShownInNotebooks, facts_of_record

if TYPE_CHECKING:
    import pyvista

    from ..records.atlas import AtlasRecord

_SHOWN = ("triangles", "faces", "charts", "not_positive", "conformity", "charts_below")


@dataclass(repr=False, kw_only=True)
class AtlasResult(ShownInNotebooks):
    """A surface as charts. atlas: as octafield.surface.atlas makes it. record: all figures, the JSON object of the
    command line."""

    atlas: Atlas
    record: AtlasRecord

    def __repr__(self) -> str:
        r = self.record
        return (
            f"AtlasResult({r.input}: {r.charts:,} charts of {r.faces:,} faces, {r.triangles:,} triangles; conformity"
            f" {r.conformity.p05:.3g} but for 5 % of the area)"
        )

    def _facts(self) -> Facts:
        return facts_of_record(self.record, _SHOWN)

    def scene(self) -> pyvista.Plotter:
        """A pyvista scene: charts in colours."""
        from ..view.window import shown_where_possible

        return shown_where_possible(self._drawn())

    def _drawn(self) -> pyvista.Plotter:
        from ..view.quad_layout import chart_scene

        mesh = self.atlas.domain.mesh
        return chart_scene(np.asarray(mesh.vertices), np.asarray(mesh.triangles), np.asarray(self.atlas.charts))

    def dataset(self) -> pyvista.PolyData:
        """The surface cut open along its charts, a point per vertex of a chart: point data uv, vertex (of the surface);
        cell data chart, face, conformity, parent (triangle of the input)."""
        import pyvista

        atlas = self.atlas
        points = np.asarray(atlas.domain.mesh.vertices)[np.asarray(atlas.origins)]
        triangles: np.ndarray = np.asarray(atlas.uv_triangles)
        surface: pyvista.PolyData = pyvista.PolyData.from_regular_faces(points, triangles)
        surface.point_data["uv"] = np.array(atlas.uv)
        surface.point_data["vertex"] = np.array(atlas.origins)
        surface.cell_data["chart"] = np.array(atlas.charts)
        surface.cell_data["face"] = np.array(atlas.faces)
        surface.cell_data["conformity"] = np.array(atlas.conformity)
        surface.cell_data["parent"] = np.array(atlas.parents)
        return surface


def compute_atlas(
    source: Source | MeshedInput,
    options: MeshOptions = MeshOptions(remesh=False),
    progress: Progress | None = None,
    *,
    atlas_options: AtlasOptions = AtlasOptions(),
) -> AtlasResult:
    """A surface, open or closed, or the boundary of a tet mesh (paths or meshes in memory) as few one-to-one charts,
    bounded by features (octafield.surface.atlas).

    options: of the repair and the features, and whether the surface is remeshed first.
    progress(phase, fraction, merit): False cancels. Raises InvalidInput, GeometryError, IoError, Cancelled.

        >>> import octafield
        >>> from octafield.domain.generators import generate
        >>> result = octafield.compute_atlas(generate("ball"))
        >>> result.record.charts, result.record.not_positive
        (1, 0)
    """
    from . import record

    memory = PeakMemory()
    meshed = (
        source
        if isinstance(source, MeshedInput)
        else prepare_mesh(source, options, volume=False, fills=True, progress=progress)
    )
    clock = PhaseClock(meshed.clock)
    with naming(meshed.name), clock.phase("surface"):
        made = _core.atlas(
            SurfaceDomain(meshed.surface, meshed.features),
            conformity=atlas_options.conformity,
            max_triangles=atlas_options.max_triangles,
            bisect=atlas_options.bisect,
            progress=forward(progress, "surface"),
        )
    told = record.of_atlas(
        meshed, clock, max(meshed.peak_mb, memory.megabytes()), made, atlas_options, meshed.options or options
    )
    return AtlasResult(atlas=made, record=told)
