"""Pickles of what there is once: entries of registries go by name."""

import copyreg

from . import _core
from ._core import Metric, Representation, Scheme
from .frame_files import FrameFormat, frame_formats
from .meshes.mesh_format import MeshFormat
from .meshes.registry import mesh_formats


def _representation(name: str) -> Representation:
    return _core.representations[name]


def _metric(name: str) -> Metric:
    return _core.metrics[name]


def _scheme(name: str) -> Scheme:
    return _core.schemes[name]


def _frame_format(name: str) -> FrameFormat:
    return frame_formats[name]


def _mesh_format(name: str) -> MeshFormat:
    return mesh_formats[name]


copyreg.pickle(Representation, lambda entry: (_representation, (entry.name,)))
copyreg.pickle(Metric, lambda entry: (_metric, (entry.name,)))
copyreg.pickle(Scheme, lambda entry: (_scheme, (entry.name,)))
copyreg.pickle(FrameFormat, lambda entry: (_frame_format, (entry.name,)))
copyreg.pickle(MeshFormat, lambda entry: (_mesh_format, (entry.name,)))
