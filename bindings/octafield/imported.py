"""Frames from elsewhere, judged as our own are: singular curves, energy, alignment, meshability."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._core import BoundaryMeshability, FeatureGraph, FrameStreamline, Integrability, Meshability, SingularGraph, TetMesh, TriangleMesh
from .analysis import analyse as analyse_frames
from .errors import InvalidInput
from .formats.base import SITES
from .formats.rotations import unit_quaternions
from .meshing import MeshedInput, Source, prepare_mesh
from .options import FieldOptions
from .phases import PeakMemory, PhaseClock, Progress, announce
from .sizes import Sizes, sizes_of_run
from .surface_pipeline import common_record
from .tet_analysis import analyse_tets

__all__ = ["AnalysedField", "analyse"]


@dataclass(repr=False)
class AnalysedField:
    """A field and its analysis; the parts are those of octafield.FieldResult. frames: at the vertices; tet_frames: (m, 4) where the field lives in
    the tets, whose analysis has no meshability and integrability."""

    surface: TriangleMesh
    features: FeatureGraph
    tets: TetMesh
    frames: np.ndarray
    singular_graph: SingularGraph
    alignment: np.ndarray
    feature_alignment: np.ndarray
    meshability: Meshability | None
    boundary_meshability: BoundaryMeshability | None
    integrability: Integrability | None
    streamlines: Sequence[FrameStreamline]
    record: dict
    regions: np.ndarray | None = None
    tet_frames: np.ndarray | None = None
    lengths: np.ndarray | None = None
    sizes: Sizes | None = None

    def __repr__(self) -> str:
        r = self.record
        return f"AnalysedField({r['vertices']} vertices, {r['tets']} tets, energy {r['energy']:.6g}, {r['singular_edges']} singular edges)"


def analyse(
    mesh: Source | MeshedInput,
    frames: ArrayLike,
    where: str = "vertices",
    options: FieldOptions = FieldOptions(),
    progress: Progress | None = None,
) -> AnalysedField:
    """Analyses (n, 4) frames at the vertices or in the tets of a tet mesh (or its file; features as octafield field finds them).

    Of the options, those of features, interfaces, streamlines, sizes and threads count. record has the keys of octafield.compute_field's that do not come from
    solving. Raises InvalidInput where the frames do not fit the mesh.
    """
    if where not in SITES:
        raise InvalidInput(f"where must be one of: {', '.join(SITES)}; not {where!r}", "unknown_option_value")
    if options.split:
        raise InvalidInput("splitting makes another mesh than the frames belong to; leave it out", "option_out_of_range")
    meshed = mesh if isinstance(mesh, MeshedInput) else prepare_mesh(mesh, options, progress=progress)
    if meshed.kind != "tets" and not isinstance(mesh, MeshedInput):
        raise InvalidInput(f"{meshed.name}: is a surface; frames need the tet mesh they belong to", "not_tets")
    memory, clock = PeakMemory(), PhaseClock(meshed.clock)
    values = fitting_frames(meshed.tets, frames, where)
    with clock.phase("analyse"):
        announce(progress, "analyse")
        if where == "tets":
            found = analyse_tets(meshed, _core.tet_sampling(meshed.tets), values, options.threads)
            parts = (found.frames, found.singular.graph, found.alignment, found.feature_alignment, None, None, None, [])
        else:
            found = analyse_frames(meshed, values, options.threads, options.streamlines)
            parts = (values, found.singular_graph, found.alignment, found.feature_alignment, found.meshability,
                     found.boundary_meshability, found.integrability, found.streamlines)  # fmt: skip
    sizes, sizes_entry = sizes_of_run(meshed.tets, parts[0], options, clock, progress)
    record = {
        **common_record(meshed, clock, max(meshed.peak_mb, memory.megabytes())),
        "vertices": len(meshed.tets.vertices),
        "tets": len(meshed.tets.tets),
        "boundary_triangles": len(meshed.surface.triangles) - meshed.interface_triangles,
        "regions": 1 if meshed.regions is None else len(np.unique(meshed.regions)),
        "sampling": where,
        "threads": options.threads,
        **found.record,
        **sizes_entry,
        "options": asdict(options),
    }
    return AnalysedField(meshed.surface, meshed.features, meshed.tets, *parts, record, meshed.regions, values if where == "tets" else None, sizes=sizes)


def fitting_frames(tets: TetMesh, frames: ArrayLike, where: str) -> np.ndarray:
    """Unit quaternions, as many as the mesh has vertices or tets; InvalidInput otherwise."""
    values = np.asarray(frames, float)
    count = len(tets.vertices if where == "vertices" else tets.tets)
    if values.shape != (count, 4):
        raise InvalidInput(f"frames of shape {values.shape}; ({count}, 4) are needed, one per {'vertex' if where == 'vertices' else 'tet'}", "bad_count")
    return unit_quaternions(values, lambda i: "frames")[0]
