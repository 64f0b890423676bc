"""Exact forms of the binary groups, for the tests beside this file.

Names: q = u + v j with u = q0 + i q1, v = q2 + i q3. Multiplication by a + b j on the right takes (u, v) to
(u a - v conj(b), u b + v conj(a)). Du Val 1964; Klein 1884; Beaufort, thesis, chapter 4 (equation numbers in brackets).
"""

import sympy as sp

u, v = sp.symbols("u v")
PHI = (1 + sp.sqrt(5)) / 2
HALF = sp.Rational(1, 2)
ROOT = sp.sqrt(2) / 2

# (4.20), (4.21), (4.23)
VIERER = ((u * v) ** 2, u**4 + v**4, u * v * (u**4 - v**4))
TETRAHEDRAL = (VIERER[2], u**8 + 14 * u**4 * v**4 + v**8, u**12 - 33 * u**4 * v**4 * (u**4 + v**4) + v**12)
OCTAHEDRAL = (TETRAHEDRAL[1], TETRAHEDRAL[0] ** 2, TETRAHEDRAL[0] * TETRAHEDRAL[2])

GENERATORS = {
    "vierer": (2, 2, (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1)),
    "tetrahedral": (3, 3, (HALF, HALF, HALF, HALF), (HALF, -HALF, HALF, HALF), (0, 0, 0, 1)),
    "octahedral": (4, 3, (ROOT, ROOT, 0, 0), (HALF, HALF, HALF, HALF), (0, ROOT, 0, ROOT)),
    "icosahedral": (5, 3, (PHI / 2, HALF, (PHI - 1) / 2, 0), (HALF,) * 4, (0, PHI / 2, (PHI - 1) / 2, HALF)),
}

ICOSAHEDRAL = (
    TETRAHEDRAL[2] + 22 / sp.sqrt(5) * TETRAHEDRAL[0] ** 2,
    TETRAHEDRAL[1] * (TETRAHEDRAL[2] - 38 * sp.sqrt(5) / 3 * TETRAHEDRAL[0] ** 2),
    TETRAHEDRAL[0]
    * (
        TETRAHEDRAL[2] ** 2
        - 116 * sp.sqrt(5) / 45 * TETRAHEDRAL[0] ** 2 * TETRAHEDRAL[2]
        + sp.Rational(3444, 25) * TETRAHEDRAL[0] ** 4
    ),
)
FORMS = {"vierer": VIERER, "tetrahedral": TETRAHEDRAL, "octahedral": OCTAHEDRAL, "icosahedral": ICOSAHEDRAL}
