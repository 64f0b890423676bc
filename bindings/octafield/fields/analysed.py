"""Frames from elsewhere, judged as our own are: singular curves, energy, alignment, meshability."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from .. import _core
from .._core import (
    BoundaryMeshability,
    FeatureGraph,
    FieldAnalysis,
    FrameStreamline,
    Integrability,
    Meshability,
    SingularGraph,
    TetDomain,
    TetFieldAnalysis,
    TriangleMesh,
)
from ..domain.inputs import feature_edges, regions_of
from ..domain.meshed_input import MeshedInput
from ..domain.meshing import Source, prepare_mesh
from ..domain.sites import SITES, fitting_frames, fitting_stretch
from ..errors import InvalidInput
from ..options import FieldOptions
from ..progress.phases import PeakMemory, PhaseClock, Progress, announce
from ..view.notebook import Facts, ShownInNotebooks, facts_of_record
from . import verdict
from .free_axes import axes_figures, off_wedges_of
from .sizes import Sizes, axis_order, sizes_of_run
from .tet_analysis import analyse_tets
from .vertex_analysis import analyse as analyse_frames

if TYPE_CHECKING:
    import pyvista

    from ..records.field import FieldRecord

__all__ = ["AnalysedField", "analyse"]

_SHOWN = ("vertices", "tets", "energy", "singular_edges", "complex_edges", "non_meshable_vertices", "converged")


@dataclass(repr=False, kw_only=True)
class AnalysedField(ShownInNotebooks):
    """A frame field and what it is judged by. frames: (n, 4) unit quaternions w x y z, per tet vertex; their axes
    are named so that neighbours agree but across a cut (octafield.volume.comb_vertices). alignment: radians, per
    boundary vertex and smooth sector, interfaces included. feature_alignment: radians, per feature tangent. record: all
    figures, the JSON object of the command line. regions: (m,) ids of the tets where the mesh has several. lengths:
    (n, 3) of the frames' axes, where they have any. sizes: an IsotropicScale or AxisScales, as the option of that name
    asks.

    A field that lives in the tets is tet_frames, (m, 4), and so are singular_graph (of singular_edges), alignment (per
    triangle and tet beside it) and lengths, meshability and boundary_meshability are those of the tets; frames is the
    field taken to the vertices, integrability is None; sizes are those of frames. feature_edges: (k, 2) ids of tets'
    vertices.

    Where axes are not at right angles they are the columns of S Q (octafield.volume.stretched_axes), Q the rotation of
    `frames` and S of `stretch`, (n, 6); else that is None. With the option axes "free", wedge_alignment is (k, 2)
    radians per wedge of boundary_meshability, from axes to both faces and to the edge (octafield.volume.
    wedge_alignment)."""

    surface: TriangleMesh
    features: FeatureGraph
    tets: TetDomain
    frames: np.ndarray
    singular_graph: SingularGraph
    alignment: np.ndarray
    feature_alignment: np.ndarray
    meshability: Meshability | None = None
    boundary_meshability: BoundaryMeshability | None = None
    integrability: Integrability | None = None
    streamlines: Sequence[FrameStreamline] = ()
    record: FieldRecord
    tet_frames: np.ndarray | None = None
    lengths: np.ndarray | None = None
    sizes: Sizes | None = None
    feature_edges: np.ndarray | None = None
    stretch: np.ndarray | None = None
    wedge_alignment: np.ndarray | None = None

    @property
    def regions(self) -> np.ndarray | None:
        """(m,) ids of the tets where the mesh has several."""
        return regions_of(self.tets)

    def __repr__(self) -> str:
        r = self.record
        return (
            f"AnalysedField({r.input}: {r.vertices:,} vertices, {r.tets:,} tets; E {r.energy:.6g},"
            f" {r.singular_edges:,} singular edges)"
        )

    def _facts(self) -> Facts:
        """For notebooks."""
        return facts_of_record(self.record, _SHOWN)

    def scene(self) -> pyvista.Plotter:
        """A pyvista scene of the singular curves inside the translucent surface: .show() opens a window, or in Jupyter
        a view to turn (with trame) or a picture. Without a display .screenshot(PNG) draws it all the same."""
        from ..view.window import shown_where_possible

        return shown_where_possible(self._drawn())

    def _drawn(self) -> pyvista.Plotter:
        """The same for pictures, without a window."""
        from ..view.curves import bad_features, singular_scene

        bad = bad_features(self.tets, self.boundary_meshability)
        return singular_scene(self.surface, self.features, self.singular_graph, bad)


def analyse(
    mesh: Source | MeshedInput,
    frames: ArrayLike,
    where: str = "vertices",
    options: FieldOptions = FieldOptions(),
    progress: Progress | None = None,
    *,
    stretch: ArrayLike | None = None,
) -> AnalysedField:
    """Analyses (n, 4) frames at the vertices or in the tets of a tet mesh (or its file; features as octafield field
    finds them). stretch: (n, 6) of axes S Q at the vertices, as results and octafield.read_frames have it.

    Of the options, those of features, interfaces, streamlines, sizes and threads count. In the record, what
    octafield.compute_field tells of solving is None. Raises InvalidInput where the frames do not fit the mesh.
    """
    if where not in SITES:
        raise InvalidInput(f"where must be one of: {', '.join(SITES)}; not {where!r}", "unknown_option_value")
    if options.split or options.split_singular:
        raise InvalidInput(
            "splitting makes another mesh than the frames belong to; leave it out", "option_out_of_range"
        )
    meshed = mesh if isinstance(mesh, MeshedInput) else prepare_mesh(mesh, options, progress=progress)
    if meshed.kind != "tets" and not isinstance(mesh, MeshedInput):
        raise InvalidInput(f"{meshed.name}: is a surface; frames need the tet mesh they belong to", "not_tets")
    axes = options.axes if stretch is None else "free"
    options = replace(options, sampling=where, axes=axes)
    values = fitting_frames(meshed.volume(), frames, where)
    stretched = fitting_stretch(meshed.volume(), stretch, values)
    return analysed_field(meshed, values, options, PhaseClock(meshed.clock), PeakMemory(), progress, stretch=stretched)


def analysed_field(
    meshed: MeshedInput,
    frames: np.ndarray,
    options: FieldOptions,
    clock: PhaseClock,
    memory: PeakMemory,
    progress: Progress | None,
    lengths: np.ndarray | None = None,
    stretch: np.ndarray | None = None,
) -> AnalysedField:
    """frames, lengths: where options.sampling has them; the axes of those at vertices are named anew, so that
    neighbours agree but across a cut. stretch: (n, 6), of frames with axes S Q. The record tells nothing of how the
    field was made."""
    from ..records.field import FieldRecord
    from . import record

    tets = meshed.volume()
    parts: dict[str, Any]
    with clock.phase("analyse"):
        announce(progress, "analyse")
        if options.sampling == "vertices":
            frames, lengths = combed(tets, frames, lengths, options.threads)
        if options.sampling == "tets":
            of_tets = analyse_tets(meshed, _core.tet_sampling(tets), frames, options.threads)
            figures, off = of_tets.figures, of_tets.off_vertices
            parts = {
                "frames": combed(tets, np.asarray(of_tets.of_field.vertex_frames), None, options.threads)[0],
                "tet_frames": frames,
                "singular_graph": of_tets.of_field.singular_edges.graph,
                "integrability": None,
                **_analysis_of(of_tets.of_field),
            }
        else:
            found = analyse_frames(
                meshed, frames, options.threads, options.streamlines, options.feature_tolerance, stretch
            )
            figures, off = found.figures, found.off_vertices
            parts = {
                "frames": frames,
                "singular_graph": found.of_field.singular_graph,
                "integrability": None if stretch is not None else found.of_field.integrability,
                "streamlines": found.streamlines,
                **_analysis_of(found.of_field),
            }
    off_wedges = off_wedges_of(tets, parts["frames"], stretch, options)
    sizes = sizes_of_run(tets, parts["frames"], options, clock, progress)
    told = FieldRecord(
        **record.of_input(meshed, clock, max(meshed.peak_mb, memory.megabytes())),
        **record.of_mesh(meshed),
        sampling=options.sampling,
        threads=options.threads,
        **figures,
        axes=axes_figures(tets, parts["frames"], stretch, parts["boundary_meshability"], off_wedges),
        sizes=None if sizes is None else record.of_sizes(sizes),
        verdict=verdict.of_field(meshed, off, figures),
        options=options.recorded(),
    )
    return AnalysedField(
        surface=meshed.surface,
        features=meshed.features,
        tets=tets,
        lengths=lengths,
        sizes=sizes,
        record=told,
        feature_edges=feature_edges(tets),
        stretch=stretch,
        wedge_alignment=off_wedges,
        **parts,
    )


def _analysis_of(found: FieldAnalysis | TetFieldAnalysis) -> dict[str, Any]:
    """What both kinds of sites have."""
    return {
        "alignment": np.asarray(found.alignment),
        "feature_alignment": np.asarray(found.feature_alignment),
        "meshability": found.meshability,
        "boundary_meshability": found.boundary_meshability,
    }


def combed(
    tets: TetDomain, frames: np.ndarray, lengths: np.ndarray | None, threads: int
) -> tuple[np.ndarray, np.ndarray | None]:
    """Frames at the vertices by octafield.volume.comb_vertices, and the lengths of their axes in the new order."""
    found = _core.comb_vertices(tets, frames, threads=threads)
    return np.asarray(found.frames), (
        None if lengths is None else np.take_along_axis(lengths, axis_order(np.asarray(found.element)), axis=1)
    )
