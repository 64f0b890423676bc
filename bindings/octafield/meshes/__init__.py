"""Readers of mesh files and CAD models: points, cells, regions and lines as a Grid (grids.py); defects with their line
or byte."""
