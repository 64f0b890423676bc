"""The record of an atlas. Imported where a record is made: pydantic takes long to import."""

from __future__ import annotations

import numpy as np

from .. import _core
from .._core import Atlas, AtlasOptions
from ..domain.meshed_input import MeshedInput
from ..fields.record import of_input
from ..options import MeshOptions
from ..progress.phases import PhaseClock
from ..records.atlas import AtlasRecord
from ..records.parts import ChartFigures, ConformityFigures


def of_atlas(
    meshed: MeshedInput,
    clock: PhaseClock,
    peak_mb: float,
    made: Atlas,
    options: AtlasOptions,
    mesh_options: MeshOptions,
) -> AtlasRecord:
    begun = of_input(meshed, clock, peak_mb)
    mesh, charts, faces = made.domain.mesh, made.chart_list, made.face_list
    points, cuts = np.asarray(mesh.vertices), np.asarray(made.cuts)
    below = sum(not chart.as_asked for chart in charts)
    added = len(mesh.triangles) - len(meshed.surface.triangles)
    notes = list(begun.notes)
    if added:
        notes.append(f"coarse faces got vertices inside: {added} triangles more, the same geometry")
    if below:
        notes.append(
            f"{below} of {len(charts)} charts miss the conformity of {options.conformity:g} or are uneven, and are too"
            " small to be split further"
        )
    return AtlasRecord(
        **{**begun, "notes": notes},
        vertices=len(points),
        triangles=len(mesh.triangles),
        added_triangles=added,
        faces=len(faces),
        handles=sum(face.genus for face in faces),
        closed_faces=sum(face.loops == 0 for face in faces),
        charts=len(charts),
        not_positive=len(_core.not_positive(made.uv, made.uv_triangles)),
        charts_below=below,
        conformity=_conformity(np.asarray(made.conformity), np.asarray(_core.triangle_areas(mesh))),
        cut_edges=len(cuts),
        cut_length=float(np.linalg.norm(points[cuts[:, 0]] - points[cuts[:, 1]], axis=1).sum()),
        chart_list=[
            ChartFigures(
                triangles=chart.triangles,
                area=chart.area,
                loops=chart.loops,
                conformity=ConformityFigures(
                    min=chart.least_conformity, p05=chart.conformity, mean=chart.mean_conformity
                ),
                evenness=chart.evenness,
            )
            for chart in charts
        ],
        options={name: getattr(options, name) for name in ("conformity", "max_triangles", "bisect")},
        mesh_options=mesh_options.recorded(),
    )


def _conformity(values: np.ndarray, areas: np.ndarray) -> ConformityFigures:
    order = np.argsort(values, kind="stable")
    place = int(np.searchsorted(np.cumsum(areas[order]), 0.05 * areas.sum(), side="right"))
    return ConformityFigures(
        min=float(values.min()),
        p05=float(values[order[min(place, len(order) - 1)]]),
        mean=float((values * areas).sum() / areas.sum()),
    )
