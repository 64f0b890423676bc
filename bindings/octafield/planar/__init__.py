"""Plane regions by their boundary: from arrays and files, and quads that keep it."""
