"""From a file to a hex-dominant mesh: read, mesh, field, cells along it, figures.

result = compute_hex_dominant("part.stl", hex_options=HexMeshOptions(edge_length=0.1))
result.mesh                       # octafield.volume.MixedMesh
result.record.hex_volume_share    # the figures
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from .. import _core
from .._core import HexDominantCounts, MixedMesh, TetDomain
from ..domain.inputs import Input, naming
from ..domain.meshed_input import MeshedInput
from ..domain.meshing import SoundInput, Source, prepare_mesh, read_sound
from ..domain.sites import fitting_frames, require_right_angles
from ..errors import InvalidInput, SolverError
from ..fields.analysed import AnalysedField, analyse
from ..fields.frame_field import compute_field
from ..frame_files import read_frames
from ..frame_files.base import frames_at
from ..options import FieldOptions
from ..progress.phases import Progress, announce
from ..view.notebook import Facts, ShownInNotebooks
from .options import HexMeshOptions
from .quality import figures_of
from .sizes import SizeAt, Sizes, size_function

if TYPE_CHECKING:
    import pyvista

    from ..records.hex_dominant import HexDominantRecord

FieldSource = str | Path | ArrayLike

_COARSE = 0.05  # difference of the volume that is worth a note
_FAR_FROM_SIZES = 3.0
_RIGHT_ANGLES = "hexahedra are made along axes at right angles so far"
_SHOWN = ("cells", "hex_volume_share", "hex_number_share", "scaled_jacobian", "volume_error")


@dataclass(repr=False, kw_only=True)
class HexDominantResult(ShownInNotebooks):
    """A hex-dominant mesh and what led to it.

    regions: (cells,) region of each cell, where the input has several. support: (n,) uint8 per vertex, 0 inside, 1 on
    the surface, 2 on a feature curve, 3 a corner. scaled_jacobians: (cells,). counts: cells at every step. field: that
    the cells follow, on its tets. record: all figures, the JSON object of the command line."""

    mesh: MixedMesh
    regions: np.ndarray | None
    support: np.ndarray
    scaled_jacobians: np.ndarray
    counts: HexDominantCounts
    field: AnalysedField
    record: HexDominantRecord

    def __repr__(self) -> str:
        r = self.record
        return (
            f"HexDominantResult({r.input}: {sum(r.cells.to_dict().values()):,} cells, {r.hex_volume_share:.1%} of the"
            f" volume in {r.cells.hexahedra:,} hexahedra)"
        )

    def _facts(self) -> Facts:
        return str(self.record.input), {name: self.record.to_dict()[name] for name in _SHOWN}

    def scene(self) -> pyvista.Plotter:
        """A pyvista scene: the mesh cut open, hexahedra coloured by their scaled Jacobians, other cells in a plain
        colour, singular curves."""
        from ..view.window import shown_where_possible

        return shown_where_possible(self._drawn())

    def _drawn(self) -> pyvista.Plotter:
        from ..view.hex_mesh import hex_scene

        return hex_scene(self.mesh, self.scaled_jacobians, self.field.singular_graph)


def compute_hex_dominant(
    source: Source | MeshedInput | AnalysedField,
    options: FieldOptions = FieldOptions(),
    progress: Progress | None = None,
    *,
    hex_options: HexMeshOptions = HexMeshOptions(),
    sizes: Sizes | None = None,
    field: FieldSource | None = None,
) -> HexDominantResult:
    """A hex-dominant mesh inside a closed surface or of a tet mesh (paths or meshes in memory), along a field that is
    computed, or along that of a result of compute_field or analyse.

    options: of the mesh that the field is computed on, and of the field. Their edge_length is that of the tets; where
        it is 0 and the input is a surface or CAD model, tets get about the edge length of the cells.
    sizes: in place of hex_options.edge_length and cells: a function of (n, 3) points; (n,) numbers at the vertices of
        the input; (k, 4) points x y z with sizes; or a file of such numbers, .npy or text.
    field: (n, 4) frames at the vertices of a tet mesh, or their file, as octafield.read_frames takes it.

    progress(phase, fraction, merit): False cancels. Raises InvalidInput, GeometryError, IoError, SolverError,
    Cancelled.

        >>> import octafield
        >>> from octafield.domain.generators import generate
        >>> result = octafield.compute_hex_dominant(generate("box"), hex_options=octafield.HexMeshOptions(cells=27))
        >>> result.record.cells.hexahedra, result.record.hex_volume_share
        (27, 1.0)
    """
    if sizes is not None and (hex_options.edge_length or hex_options.cells):
        raise InvalidInput("sizes stand for an edge length or a number of cells; leave one out", "option_out_of_range")
    if options.axes == "free":
        raise InvalidInput(_RIGHT_ANGLES + "; take axes 'orthogonal'", "stretched_axes")
    given, at = _field_of(source, options, progress, hex_options, sizes, field)
    require_right_angles(given.stretch, _RIGHT_ANGLES)
    with naming(given.record.input):
        return _mesh_along(given, _name_of(source, field), options, hex_options, sizes, at, progress)


def _field_of(
    source: Source | MeshedInput | AnalysedField,
    options: FieldOptions,
    progress: Progress | None,
    cells: HexMeshOptions,
    sizes: Sizes | None,
    field: FieldSource | None,
) -> tuple[AnalysedField, SizeAt | None]:
    """The field that the cells will follow, and the sizes."""
    if isinstance(source, AnalysedField):
        if field is not None:
            raise InvalidInput("a result has its field; leave the other one out", "option_out_of_range")
        return source, _sizes_on(sizes, source.record.input, source.tets)
    if isinstance(source, MeshedInput):
        meshed, at = source, _sizes_on(sizes, source.name, source.volume())
    elif field is not None and isinstance(field, (str, Path)):
        return _read_field(source, options, progress, sizes, field)
    else:
        meshed, at = _meshed(source, options, progress, cells, sizes)
    if field is not None:
        if meshed.kind != "tets":
            raise InvalidInput(f"{meshed.name}: is a surface; a field that is given needs its tet mesh", "not_tets")
        frames = fitting_frames(meshed.volume(), field, "vertices")  # type: ignore[arg-type]
        return analyse(meshed, frames, "vertices", options, progress), at
    length = meshed.options.edge_length if meshed.options else options.edge_length
    return compute_field(meshed, replace(options, edge_length=length), progress), at


def _read_field(
    source: Source, options: FieldOptions, progress: Progress | None, sizes: Sizes | None, field: str | Path
) -> tuple[AnalysedField, SizeAt | None]:
    if options.split:
        raise InvalidInput(
            "splitting makes another mesh than the field belongs to; leave it out", "option_out_of_range"
        )
    sound = read_sound(source, options, progress=progress)
    sound.found.volume()
    found = read_frames(field, sound.found)
    frames = frames_at(found, "vertices")
    at = None if sizes is None else size_function(sizes, sound.found)
    result = analyse(prepare_mesh(sound, options, progress=progress), frames, "vertices", options, progress)
    notes = list(dict.fromkeys([*result.record.notes, *found.notes]))
    result.record = result.record.changed(field=str(field), field_format=found.format, notes=notes)
    return result, at


def _meshed(
    source: Source, options: FieldOptions, progress: Progress | None, cells: HexMeshOptions, sizes: Sizes | None
) -> tuple[MeshedInput, SizeAt | None]:
    """Tets get the edge length of the cells where none is given. CAD models are meshed by reading, so that they are
    read again where the length is known only then."""
    first = replace(options, edge_length=options.edge_length or cells.edge_length)
    sound = read_sound(source, first, progress=progress)
    at = None if sizes is None else size_function(sizes, sound.found)
    with naming(sound.found.name):
        length = first.edge_length or _tet_length(sound, cells, at)
        if sound.found.tets is None:
            _require_count(sound, cells, cells.edge_length or (length if at is not None else 0.0))
    fitting = replace(options, edge_length=length)
    if sound.found.tets is not None and not sound.found.of_cad:
        return prepare_mesh(sound, options, progress=progress), at
    if sound.found.of_cad and length != first.edge_length:
        sound = read_sound(source, fitting, progress=progress)
    return prepare_mesh(sound, fitting, progress=progress), at


def _require_count(sound: SoundInput, cells: HexMeshOptions, length: float) -> None:
    """Before the surface is made of as small triangles, which would hardly end. A part that is thin all over has few
    cells but a large surface."""
    if not length:
        return
    volume, area = _volume_and_area(sound)
    count, triangles = volume / length**3, area / (0.433 * length**2)
    if count > cells.most_hexahedra:
        what = f"about {count:.2g} cells, and at most {cells.most_hexahedra} are made"
    elif triangles > cells.most_hexahedra / 10:
        what = f"about {triangles:.2g} triangles on the surface, and at most {cells.most_hexahedra // 10} are made"
    else:
        return
    raise InvalidInput(
        f"the edge length asks for {what}; give a larger edge length, or more most_hexahedra", "too_many_cells"
    )


def _tet_length(sound: SoundInput, cells: HexMeshOptions, at: SizeAt | None) -> float:
    """0: what fits the shape."""
    points = np.asarray(sound.found.surface.vertices)
    if at is not None:
        return float(np.mean(at(points)))
    if not cells.cells:
        return 0.0
    return float(np.cbrt(_volume_and_area(sound)[0] / cells.cells))


def _volume_and_area(sound: SoundInput) -> tuple[float, float]:
    points = np.asarray(sound.found.surface.vertices)
    points = points - points[:1]  # far from the origin products would lose all digits
    a, b, c = (points[np.asarray(sound.found.surface.triangles)[:, k]] for k in range(3))
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    return abs(float(np.einsum("ij,ij->", a, np.cross(b, c)))) / 6, float(areas.sum())


def _sizes_on(sizes: Sizes | None, name: str, domain: TetDomain) -> SizeAt | None:
    return None if sizes is None else size_function(sizes, Input(name, domain.surface.mesh, domain))


def _name_of(source: object, field: FieldSource | None) -> str:
    if isinstance(source, AnalysedField):
        return "computed" if source.record.computed else source.record.field or "given"
    return "computed" if field is None else str(field) if isinstance(field, (str, Path)) else "given"


def _mesh_along(
    field: AnalysedField,
    name: str,
    options: FieldOptions,
    cells: HexMeshOptions,
    sizes: Sizes | None,
    at: SizeAt | None,
    progress: Progress | None,
) -> HexDominantResult:
    from ..progress.meter import PhaseMeter
    from . import record

    domain = field.tets
    volumes = np.asarray(_core.tet_volumes(domain))
    length = cell_length(cells, domain)
    wanted = None if at is None else at(np.asarray(domain.vertices))
    if wanted is not None:
        length = float((wanted[np.asarray(domain.tets)].mean(axis=1) * volumes).sum() / volumes.sum())
    meter = PhaseMeter(field.record, progress)
    made = _core.hex_dominant(
        domain,
        field.frames,
        edge_length=length,
        sizes=wanted,
        threads=options.threads,
        progress=meter.report,
        **cells.of_cells(),
    )
    meter.begin("check")
    announce(progress, "check")
    require_sound(made.mesh)
    regions = np.asarray(made.regions) if len(made.regions) else None
    figures = figures_of(made.mesh, regions, domain, at, options.threads)
    meter.end()
    told = record.of_mesh(
        made,
        figures,
        field.record,
        name,
        length,
        meter,
        {**vars(cells), "sizes": record.recorded_sizes(sizes)},
    )
    if told.volume_error > _COARSE:
        note = (
            f"the mesh has another volume than the input, by {told.volume_error:.0%}: the cells are large for how the"
            " surface bends; give a smaller edge length"
        )
        told = told.changed(notes=[*told.notes, note])
    if told.edge_to_size is not None and told.edge_to_size.p95 > _FAR_FROM_SIZES:
        note = (
            f"5 % of the edges are more than {told.edge_to_size.p95:.1f} times as long as the sizes wanted there: these"
            " vary faster than the tets of the field resolve; give smaller tets, or sizes that vary less"
        )
        told = told.changed(notes=[*told.notes, note])
    return HexDominantResult(
        mesh=made.mesh,
        regions=regions,
        support=np.asarray(made.support),
        scaled_jacobians=figures.scaled_jacobians,
        counts=made.counts,
        field=field,
        record=told,
    )


def cell_length(cells: HexMeshOptions, domain: TetDomain) -> float:
    """Wanted edge of the cells, input unit."""
    if cells.edge_length:
        return cells.edge_length
    if cells.cells:
        return float(np.cbrt(np.asarray(_core.tet_volumes(domain)).sum() / cells.cells))
    return float(_core.mean_edge_length(domain.surface.mesh))


def require_sound(mesh: MixedMesh) -> None:
    """Raises SolverError where the mesh is not fit for use: that is a defect of the program, not of the input."""
    defects: Sequence[_core.CellDefect] = _core.find_cell_defects(mesh)
    if defects:
        worst = defects[0]
        raise SolverError(
            f"the hex-dominant mesh is not sound: {worst.message}", worst.kind, [int(c) for c in worst.cells[:100]]
        )
