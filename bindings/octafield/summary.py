"""The columns of the summary table, for the report and the terminal: head, number format and meaning in one place."""

from collections.abc import Callable
from dataclasses import dataclass

from .phases import PHASES


@dataclass(frozen=True)
class Column:
    """value(input name, record) is shown with format `form` (empty: text). meaning: HTML. report_only: not on the
    terminal, where lines are short."""

    head: str
    value: Callable[[str, dict], object]
    form: str
    meaning: str
    group: str = ""
    report_only: bool = False

    def show(self, value) -> str:
        return format(value, self.form) if self.form else str(value)


def total_seconds(record: dict, kind: str = "wall_seconds") -> float:
    return sum(record[kind].values())


def _phase(phase: str, meaning: str) -> Column:
    return Column(phase, lambda _, r: r["wall_seconds"][phase], ".2f", meaning, "seconds")


_PHASE_MEANINGS = {
    "read": "reading and testing the input (shared by the runs on it)",
    "mesh": "features, remeshing, tetrahedra (shared)",
    "surface": "cross field on the surface, its singular points and separatrices (shared by the runs with one seed)",
    "smooth": "boundary constraints, start and smoothing",
    "analyse": "singular curves, alignment, energy, streamlines",
    "write": "the files of the run",
}

COLUMNS: tuple[Column, ...] = (
    Column("input", lambda name, r: name, "", "the file"),
    Column("representation", lambda _, r: r["representation"], "", "what the frames were smoothed as"),
    Column(
        "boundary",
        lambda _, r: r["boundary"],
        "",
        "fixed: frames held at the surface cross field; aligned: one axis on the normal, twist free; none: free",
    ),
    Column("seed", lambda _, r: r["seed"], "d", "of every random start"),
    Column("vertices", lambda _, r: r["vertices"], ",d", "of the tet mesh"),
    Column("tets", lambda _, r: r["tets"], ",d", "tetrahedra"),
    Column(
        "sh4",
        lambda _, r: r["energy"],
        ".6g",
        "Dirichlet energy E = &frac12; &sum;<sub>c</sub> a<sub>c</sub><sup>T</sup> L a<sub>c</sub>, "
        "a the sh4 vectors of the final frames, L the stiffness matrix of linear elements; "
        "compare on one mesh only: singular curves make it grow with refinement",
        "energy",
    ),
    Column(
        "unit speed",
        lambda _, r: r["energy_unit_speed"],
        ".6g",
        "3/20 of it: the energy of an embedding in which a frame turning by 1 radian moves by 1",
        "energy",
    ),
    Column(
        "edges",
        lambda _, r: r["singular_edges"],
        ",d",
        "triangles round which the frames turn: edges of the dual mesh on singular curves",
        "singular",
    ),
    Column(
        "length",
        lambda _, r: r["singular_length"],
        ".4g",
        "total length of the singular curves, unit of the input",
        "singular",
    ),
    Column(
        "complex",
        lambda _, r: r["complex_edges"],
        ",d",
        "singular edges whose rotation keeps no axis of the frame; no hex mesh has them",
        "singular",
    ),
    Column(
        "non-meshable",
        lambda _, r: r["non_meshable_vertices"],
        ",d",
        "places where singular curves meet, change or reach the surface in a way no hex mesh has (a necessary "
        "condition: the others may still have none); nodes that complex edges join count one by one",
        "singular",
    ),
    Column(
        "edges",
        lambda _, r: r["non_meshable_feature_edges"],
        ",d",
        "feature edges at which the turn of the field leaves no hexahedron (a necessary condition)",
        "non-meshable features",
        report_only=True,
    ),
    Column(
        "corners",
        lambda _, r: r["non_meshable_corners"],
        ",d",
        "corners at which the numbers of hexahedra and quadrilaterals round them fit no hex mesh (a necessary condition)",
        "non-meshable features",
        report_only=True,
    ),
    Column(
        "median",
        lambda _, r: r["alignment_deg"]["median"],
        ".2f",
        "angle between surface normal and nearest frame axis, over boundary vertices and their smooth sectors",
        "alignment \N{DEGREE SIGN}",
    ),
    Column("max", lambda _, r: r["alignment_deg"]["max"], ".2f", "its maximum", "alignment \N{DEGREE SIGN}"),
    Column(
        "features",
        lambda _, r: r["feature_alignment_deg"]["max"],
        ".2f",
        "largest angle between a feature curve and the nearest frame axis, corners included",
        "alignment \N{DEGREE SIGN}",
        report_only=True,
    ),
    Column(
        "jump",
        lambda _, r: r["integrability"]["jump_rms"],
        ".3g",
        "jump of the axes along the face between two tets, root mean square: 0 for gradients of a map, of the order of "
        "the mesh width on smooth fields; compare on one mesh only",
        "integrability",
        report_only=True,
    ),
    Column("iterations", lambda _, r: r["iterations"], "d", "diffusion steps and iterations of smoothing"),
    *(_phase(phase, _PHASE_MEANINGS[phase]) for phase in PHASES),
    Column("total", lambda _, r: total_seconds(r), ".2f", "sum of the phases, wall clock", "seconds"),
    Column(
        "peak MB",
        lambda _, r: r["peak_mb"],
        ",.0f",
        "largest resident memory of the process during the run, its libraries included",
    ),
)
