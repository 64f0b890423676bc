"""Whole pieces of work on files: comparisons, fields of others, conversions, and the folder of one run."""
