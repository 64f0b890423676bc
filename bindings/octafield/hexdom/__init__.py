"""Hex-dominant meshes: from a file to a mesh that a solver can use, with its figures."""
