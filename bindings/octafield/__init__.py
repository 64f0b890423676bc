"""octafield: hexahedral frame fields on surfaces and in volumes.

    >>> import octafield
    >>> from octafield.domain.generators import generate
    >>> surface = generate("box")                     # or octafield.read_surface("part.stl")
    >>> octafield.require_valid(surface)
    >>> result = octafield.compute_field(surface)     # the whole way, see octafield.fields.frame_field
    >>> result.record.singular_edges
    0
    >>> frames = octafield.frames.random_rotations(10)  # or one step at a time
    >>> octafield.frames.sh4_embed(frames).shape
    (10, 9)

Quaternions are (w, x, y, z), angles radians, lengths the input's unit, ids 0-based and -1 for none. Array properties
are numpy views of the C++ memory. Long calls run without the GIL, take progress(phase, fraction, merit) -> bool | None,
and stop within a second on Ctrl-C. Errors are octafield.Error and its subclasses, with .kind and .elements.
"""

from . import frames, surface, volume
from . import pickling as _pickling  # noqa: F401
from ._core import (
    FeatureGraph,
    SingularGraph,
    TetDomain,
    TetMesh,
    TriangleMesh,
    __version__,
    read_surface,
    require_valid,
    write_surface,
)
from .atlas.atlas import AtlasResult, compute_atlas
from .domain.cell_files import read_cells, write_cells
from .domain.meshed_input import MeshedInput
from .domain.meshing import prepare_mesh
from .domain.parameterization import ParameterizationInput, parameterization_input
from .errors import Cancelled, Error, GeometryError, InvalidInput, IoError, SolverError
from .fields.analysed import AnalysedField, analyse
from .fields.direction_field import SurfaceFieldResult, compute_surface_field
from .fields.frame_field import FieldProblem, FieldResult, compute_field, prepare_field, run_field
from .fields.probes import sample_frames, slice_frames
from .frame_files import FrameFile, FrameFormat, frame_formats, read_frames, write_frames
from .hexdom.hex_mesh import HexDominantResult, compute_hex_dominant
from .hexdom.options import HexMeshOptions
from .hexmesh.hex_mesh import HexMeshResult, compute_hex_mesh
from .hexmesh.seamless import SeamlessMapResult, compute_seamless_map
from .layout.options import QuadLayoutOptions
from .layout.quad_layout import QuadLayoutResult, compute_quad_layout
from .meshes.mesh_format import MeshFormat
from .meshes.registry import mesh_formats, register_mesh_format
from .options import FieldOptions, MeshOptions, SurfaceFieldOptions
from .planar.geojson import outline_of_geojson
from .planar.outline import planar_outline, resampled_outline
from .planar.quads import FixedBoundaryFigures, FixedBoundaryResult, compute_fixed_boundary_quads
from .planar.read import read_outline
from .quad_mesh.grid_maps import corner_coordinates, write_grid_map
from .quad_mesh.options import QuadMeshOptions
from .quad_mesh.quad_mesh import QuadMeshResult, compute_quad_mesh
from .records.record_file import read_record, read_surface_record
from .remeshing.options import RemeshingOptions
from .remeshing.remesh import RemeshedSurface, compute_remesh
from .runs.compare import Comparison, compare
from .runs.conversion import Conversion, convert_file
from .runs.interop import from_meshio, from_pandas, from_pyvista, to_meshio, to_pandas, to_pyvista, to_scipy
from .view import arrays as _arrays  # noqa: F401

__all__ = [
    "AnalysedField",
    "AtlasResult",
    "Cancelled",
    "Comparison",
    "Conversion",
    "Error",
    "FeatureGraph",
    "FieldOptions",
    "FieldResult",
    "FixedBoundaryFigures",
    "FixedBoundaryResult",
    "FrameFile",
    "FrameFormat",
    "GeometryError",
    "HexDominantResult",
    "HexMeshOptions",
    "HexMeshResult",
    "InvalidInput",
    "IoError",
    "MeshFormat",
    "MeshOptions",
    "MeshedInput",
    "ParameterizationInput",
    "FieldProblem",
    "QuadLayoutOptions",
    "QuadLayoutResult",
    "QuadMeshOptions",
    "QuadMeshResult",
    "RemeshedSurface",
    "RemeshingOptions",
    "SeamlessMapResult",
    "SingularGraph",
    "SolverError",
    "SurfaceFieldOptions",
    "SurfaceFieldResult",
    "TetDomain",
    "TetMesh",
    "TriangleMesh",
    "__version__",
    "analyse",
    "compare",
    "compute_atlas",
    "compute_field",
    "compute_fixed_boundary_quads",
    "compute_hex_dominant",
    "compute_hex_mesh",
    "compute_quad_layout",
    "compute_quad_mesh",
    "compute_remesh",
    "compute_seamless_map",
    "compute_surface_field",
    "convert_file",
    "corner_coordinates",
    "frame_formats",
    "frames",
    "from_meshio",
    "from_pandas",
    "from_pyvista",
    "mesh_formats",
    "outline_of_geojson",
    "parameterization_input",
    "planar_outline",
    "prepare_field",
    "prepare_mesh",
    "read_cells",
    "read_frames",
    "read_outline",
    "read_record",
    "read_surface",
    "read_surface_record",
    "register_mesh_format",
    "require_valid",
    "resampled_outline",
    "run_field",
    "sample_frames",
    "slice_frames",
    "surface",
    "to_meshio",
    "to_pandas",
    "to_pyvista",
    "to_scipy",
    "volume",
    "write_cells",
    "write_frames",
    "write_grid_map",
    "write_surface",
]
