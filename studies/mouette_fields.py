"""Frame fields that mouette computes, read from the files it writes, analysed and polished by octafield.

    pip install mouette==1.2.8      # not a dependency of octafield
    python studies/mouette_fields.py -o out/mouette

mouette has one frame per tet. E: Dirichlet energy of frames in tets (octafield.volume.tet_sampling), of mouette's
field, of octafield's smoothing from there with one axis on the normal of the surface, and of octafield's own field. No
features. DIR/BODY-report/report.html shows them side by side.
"""

import argparse
import time
import warnings
from pathlib import Path

import meshio
import numpy as np
import octafield
from octafield.domain.generators import generate
from study_output import markdown_table

BODIES = {"ball": 0.4, "cylinder": 0.4, "torus": 0.35}  # and the edge length
HEAD = ["body", "tets", "mouette: s", "E", "singular edges", "complex", "polished: E", "singular edges", "complex",
        "octafield: E", "singular edges", "complex",
        "median alignment, degrees: mouette", "polished"]  # fmt: skip
OPTIONS = octafield.FieldOptions(sampling="tets", features="none")


def by_mouette(tets: octafield.TetMesh, folder: Path, name: str) -> tuple[Path, float]:
    """The .frame file and seconds."""
    import mouette
    from mouette.processing.framefield.cells import FrameField3DCells

    mend(mouette)
    mesh_path, path = folder / f"{name}.mesh", folder / f"{name}.frame"
    meshio.Mesh(np.asarray(tets.vertices), [("tetra", np.asarray(tets.tets))]).write(mesh_path)
    start = time.perf_counter()
    field = FrameField3DCells(mouette.mesh.load(str(mesh_path)), verbose=False)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        field.run()
    seconds = time.perf_counter() - start
    field.export_frames_to_file(str(path))
    return path, seconds


def mend(mouette) -> None:
    """Attributes come back as plain arrays beside numpy 2.4, which `FrameField3DCells.initialize` does not expect
    (mouette 1.2.8)."""
    attributes = mouette.mesh.mesh_attributes.ArrayAttribute
    if hasattr(attributes, "mended"):
        return
    plain = attributes.__getitem__

    def as_vector(self, key):
        value = plain(self, key)
        return mouette.geometry.Vec(value) if isinstance(value, np.ndarray) and value.shape == (3,) else value

    attributes.__getitem__, attributes.mended = as_vector, True


def row(name: str, surface: octafield.TriangleMesh, length: float, folder: Path) -> list:
    meshed = octafield.prepare_mesh(surface, octafield.FieldOptions(edge_length=length, features="none"))
    tets = meshed.tets
    path, seconds = by_mouette(tets, folder, name)
    compared = octafield.compare(
        folder / f"{name}.mesh",
        folder / f"{name}-report",
        representations=["sh4"],
        boundaries=["aligned"],
        options=OPTIONS,
        fields={"mouette": path},
    )
    ours, polished, theirs = compared.rows
    return [name, len(tets.tets), seconds, *(r[key] for r in (theirs, polished, ours)
                for key in ("energy", "singular_edges", "complex_edges")),
            theirs["alignment_deg"]["median"], polished["alignment_deg"]["median"]]  # fmt: skip


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, required=True)
    folder = parser.parse_args().output
    folder.mkdir(parents=True, exist_ok=True)
    rows = [row(name, generate(name), length, folder) for name, length in BODIES.items()]
    table = markdown_table(HEAD, [[f"{x:.4g}" if isinstance(x, float) else x for x in row] for row in rows])
    (folder / "mouette.md").write_text(table)
    print(table)


if __name__ == "__main__":
    main()
