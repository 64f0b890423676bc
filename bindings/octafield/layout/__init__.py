"""Quad layouts and block-structured quads: from a file to a mesh of quads that keeps its blocks, with its figures."""
