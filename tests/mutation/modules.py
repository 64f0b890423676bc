"""Which tests belong to which module: those that must fail when a line of it is wrong.

equivalent: mutants that no test can tell from the original, {part of what is printed: reason}; they are not counted.
"""

from dataclasses import dataclass, field


@dataclass(frozen=True)
class Module:
    """tests: files and tests of tests/python, as pytest names them, the quickest first; or a filter of GoogleTest.
    target: of ninja, for C++."""

    tests: tuple[str, ...]
    target: str = ""
    equivalent: dict[str, str] = field(default_factory=dict)


_LEFT = "any negative length is, to NumPy, the one that is left"
_HERE = "test_orders_and_tolerances.py"

PYTHON = {
    "frame_files/placing.py": Module(("test_placing.py",
        f"{_HERE}::test_frames_and_lengths_go_together_to_the_nearest_centre",
        f"{_HERE}::test_centres_are_those_of_the_mesh_within_a_millionth_of_its_diagonal"),
        equivalent={"LtE to Lt: if len(wanted)": "differs where a centre is off by the tolerance to the last bit"}),
    "domain/rotations.py": Module(("test_axes_and_frames.py",),
        equivalent={"_EXACT = 1e-12": "axes so near are the same frame to rounding, whether they go through the "
                                      "decomposition or not"}),
    "frame_files/text.py": Module(("test_text_frames.py",), equivalent={
        "1 to 2: return np.swapaxes(rows.reshape(-1": _LEFT, "1 to 2: return from_axes(path, \"geogram\"": _LEFT,
        "1 to 2: write_whole(path, rows_of(axes_in_rows(field.frames).reshape(-1": _LEFT,
        "1 to 2: count = -1": "any number below 0 is refused alike",
        "10000 to 10001": "how far a first line is looked for",
    }),
    "meshes/text_meshes.py": Module(("test_text_mesh_rows.py",)),
    "fields/sizes.py": Module(("test_size_parts.py",),
        equivalent={"0 to 1: def find_sizes": "results are the same at any number of threads"}),
    "study/memory.py": Module((f"{_HERE}::test_memory_reserved_is_the_formula_of_the_page_and_more_than_was_measured",
        )),
    "study/plan.py": Module(("test_study_keys.py", "test_study_description.py"), equivalent={
        "True to False: chosen = dict(zip": "both have one entry per option",
        "True to False: return (self.name, json.dumps": "the order of the options is that of the class; sorting it "
                                                        "changes no group",
    }),
    "fields/tet_analysis.py": Module(
    (f"{_HERE}::test_energy_at_unit_speed_is_that_of_frames_that_move_by_one_per_radian",
        f"{_HERE}::test_singular_edges_of_frames_in_tets_are_counted_by_turns_from_the_highest_on"),
        equivalent={"0 to 1: def analyse_tets": "results are the same at any number of threads"}),
}  # fmt: skip

CPP = {
    "surface/field/src/singular_place.cpp": Module(("FittedPlace.*:SingularPlaces.Zeros*:SingularPlaces.Corners*",),
        "test_surface", {
        "away == 0.0 ?": "a value at the point itself has weight 0",
        "Complex mean = 1": "where the method starts from",
        "std::min(2 * 1.0, std::norm": "how much more the values beyond an edge weigh; a sound field's place does not "
                                       "depend on it",
        "int entry = -2": "no side, either way",
        "int steps = 1": "a bound far above what a step of an edge length crosses",
        "step < 30": "the bound of a method that has converged, or has not",
        "step = 0; step": "the bound of a method that has converged, or has not",
        "change.norm() <": "how far it converges; both are far below a tenth of an edge",
        ">= most_moved": "differs where the point moves by the bound to the last bit",
        "std::abs(*way) <": "how far it converges; both are below a tenth of an edge",
        "radii[] =": "how far the fit looks; both radii reach a tenth of an edge where no other point is near",
        "1e-300": "keeps a step of length 0 from a division by 0; any number near 0 does",
        "unexplained <= most": "differs where the angle is the bound to the last bit",
        "std::polar(2 * 1.0": "the angle of a number does not depend on its length",
    }),
    "surface/field/src/surface_singularities.cpp": Module(
    ("FittedPlace.*:SingularPoints.*:SingularPlaces.Corners*:SurfaceSingularities.*",), "test_surface",
    {"assert(": "the check of rounding is not in a release",
        "1e-3 * (charted.centroid": "a little to the side, whichever",
        "std::size_t c = 1; c <": "sums of turns are rounded to whole ones, one corner's is below a half"}),
    "volume/analysis/src/singularities.cpp": Module(("Singular*:*/StraightLine*",), "test_volume", {
        "norm <= shortest": "which of two sides that are equally near",
        "if (s > 0 && t": "a point on a side is found again as that side's",
        "const int next = (k + 2) % 3": "the same three sides",
        "if (determinant > ": "how nearly three vectors are on a line; the point is then on a side to rounding",
        "{s, -2,": "a place that is set before it is read",
    }),
}  # fmt: skip
