"""Words that options of hex meshes may be."""

WALLS = ("file", "own")  # compute_hex_mesh
FALLBACKS = ("hex-dominant", "none")  # where a mesh does not become hexahedra alone
