"""Meshes of VTK: legacy files, .vtu and .vtp."""
