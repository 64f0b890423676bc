"""Pickles of what the compiled module holds once: entries of its registries go by name."""

import copyreg

from . import _core
from ._core import Metric, Representation


def _representation(name: str) -> Representation:
    return _core.representations[name]


def _metric(name: str) -> Metric:
    return _core.metrics[name]


copyreg.pickle(Representation, lambda entry: (_representation, (entry.name,)))
copyreg.pickle(Metric, lambda entry: (_metric, (entry.name,)))
