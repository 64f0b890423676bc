"""Triangles of wanted sizes on a surface, all of good shape, their vertices on it."""
