"""Carries the runs of a study out: here in processes, or on a cluster of dask."""
