"""Wall seconds of each phase of the chain on one part at growing mesh size.

    python studies/benchmarks/chain.py [SURFACE] [--fractions 0.06,0.045,0.034] [--boundary aligned]

Default part: the nut that comes with pyvista. The last line gives the exponent p of seconds ~ tets^p between the last two sizes: about 1 where a phase
is linear in the mesh. Take figures of one run only; absolute seconds depend on the machine.
"""

import argparse
import math

from pyvista import examples

import octafield
from octafield.pipeline import prepare, prepare_mesh, run

PHASES = ("read", "mesh", "surface", "smooth", "analyse")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("surface", nargs="?", default=examples.nutfile)
    parser.add_argument("--fractions", default="0.06,0.045,0.034", help="edge lengths over the bounding-box diagonal, coarse to fine")
    parser.add_argument("--boundary", default="aligned", choices=("aligned", "fixed", "none"))
    arguments = parser.parse_args()
    surface = octafield.read_surface(arguments.surface)
    diagonal = octafield.bounding_box_diagonal(surface.vertices)

    rows = []
    print(f"{'vertices':>9} {'tets':>9} {'iterations':>10} " + " ".join(f"{phase:>9}" for phase in PHASES))
    for fraction in map(float, arguments.fractions.split(",")):
        problem = prepare(prepare_mesh(surface, octafield.MeshOptions(edge_length=fraction * diagonal)))
        record = run(problem, octafield.FieldOptions(boundary=arguments.boundary)).record
        seconds = record["wall_seconds"]
        rows.append((record["tets"], seconds))
        print(f"{record['vertices']:9d} {record['tets']:9d} {record['iterations']:10d} " + " ".join(f"{seconds[phase]:9.3f}" for phase in PHASES))
    if len(rows) > 1:
        (tets_a, a), (tets_b, b) = rows[-2:]
        exponents = (math.log(b[p] / a[p]) / math.log(tets_b / tets_a) if a[p] > 0 and b[p] > 0 else float("nan") for p in PHASES)
        print(f"{'exponent':>30} " + " ".join(f"{p:9.2f}" for p in exponents))


if __name__ == "__main__":
    main()
