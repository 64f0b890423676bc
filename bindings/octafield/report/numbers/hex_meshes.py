"""Hex-dominant meshes along the fields: methods ranked by what hexahedra are of the volume, then of the cells."""

from __future__ import annotations

import html
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..page.words import counted, listed, sentence
from .columns import percent, worst
from .records import Method, Results, Run, Setting
from .tables import Column, Table

if TYPE_CHECKING:
    from ...records.parts import HexDominantFigures

_DIGITS = 3  # of shares that are compared: a tenth of a per cent
_MANY = 3  # names, or errors, before "and so many more"
_HEX, _OFF = "hexahedra", "off the input, %"

_Place = tuple[str, int]  # input and seed


@dataclass(frozen=True)
class _Line:
    """meshes: by input and seed. complete: there is one wherever any line has one."""

    setting: Setting
    method: Method
    meshes: dict[_Place, HexDominantFigures]
    complete: bool

    def mean(self, value: Callable[[HexDominantFigures], float | None]) -> float | None:
        """Over inputs, of the means over seeds; None where a mesh has none."""
        by_input: dict[str, list[float | None]] = {}
        for (name, _), mesh in self.meshes.items():
            by_input.setdefault(name, []).append(value(mesh))
        known = [[one for one in values if one is not None] for values in by_input.values()]
        return float(np.mean([np.mean(values) for values in known])) if known and all(known) else None

    @property
    def shares(self) -> tuple[float, float]:
        """Of the hexahedra by volume and by number, as far as they are compared; -1 without meshes."""
        by_volume, by_number = self.mean(lambda m: m.hex_volume_share), self.mean(lambda m: m.hex_number_share)
        if by_volume is None or by_number is None:
            return -1.0, -1.0
        return round(by_volume, _DIGITS), round(by_number, _DIGITS)

    @property
    def rank(self) -> tuple[bool, float, float]:
        by_volume, by_number = self.shares
        return not self.complete, -by_volume, -by_number


def hex_mesh_table(results: Results) -> Table:
    """A line per boundary treatment and method, the best first; no line where no meshes were asked for."""
    columns = (
        Column("boundary"),
        Column("method"),
        Column("meshes", "d", "inputs and seeds with a mesh; where another method has more, methods are not ranked"),
        Column("of", "d", "inputs and seeds"),
        Column("volume, %", ".1f", "what hexahedra are of the volume; mean over inputs of means over seeds", _HEX),
        Column("cells, %", ".1f", "what they are of the number of cells, likewise", _HEX),
        Column("worst", ".3f", "the least of their scaled Jacobians in any mesh", _HEX),
        Column("mean", ".3f", "their mean scaled Jacobian, mean over meshes", _HEX),
        Column("volume", ".3f", "difference of the volumes of mesh and input over the input's, largest", _OFF),
        Column("surface", ".3f", "largest distance between the surfaces, over the diagonal of the input's box", _OFF),
        Column("inverted", ",d", "cells with a corner turned inside out, sum"),
        Column("nonconforming", ",d", "faces that do not match, sum"),
        Column("seconds", ".3g", "by the clock, of making and judging the meshes, sum"),
    )
    places = len({(case.input, case.seed) for case in results.cases})
    rows = [
        [line.setting.name, line.method.name, len(line.meshes), places, *_figures(line)] for line in _lines(results)
    ]
    return Table("hex_meshes", columns, rows)


def _figures(line: _Line) -> list[object]:
    meshes = line.meshes.values()

    def over(of: Callable[[list[float]], float], value: Callable[[HexDominantFigures], float | None]) -> float | None:
        known = [one for one in map(value, meshes) if one is not None]
        return of(known) if known else None

    return [
        percent(line.mean(lambda m: m.hex_volume_share)),
        percent(line.mean(lambda m: m.hex_number_share)),
        over(min, worst),
        line.mean(
            lambda m: m.scaled_jacobian["hexahedra"].mean if worst(m) is not None and m.scaled_jacobian else None
        ),
        over(max, lambda m: percent(m.volume_error)),
        over(max, lambda m: None if m.boundary_deviation is None else percent(m.boundary_deviation.max)),
        over(sum, lambda m: m.inverted),
        over(sum, lambda m: m.nonconforming_faces),
        over(sum, lambda m: m.seconds),
    ]


def hex_meshes(results: Results, cite: str) -> list[str]:
    """Which representation leads to the best mesh, and why some fields have none; none where none were asked for."""
    lines = _lines(results)
    if not lines:
        return []
    ranked = [line for line in lines if line.complete]
    left = [line for line in lines if not line.complete]
    text = []
    if ranked:
        text.append(_best(results, ranked, cite))
        if left:
            text.append(f"not ranked, for want of a mesh that another method has: {_named(results, left)} {cite}")
    elif any(line.meshes for line in lines):
        text.append(f"no method has a mesh on every input, so methods are not ranked by their meshes {cite}")
    return [" ".join(sentence(part) for part in (*text, _failures(results)) if part)]


def _best(results: Results, ranked: list[_Line], cite: str) -> str:
    best = [line for line in ranked if line.shares == ranked[0].shares]
    others = ranked[len(best) :]
    by_volume, by_number = (f"{100 * share:.1f} %" for share in ranked[0].shares)
    places = len({name for name, _ in ranked[0].meshes})
    where = f" on average over {counted(places, 'input')}" if places > 1 else ""
    worth = f"hexahedra are {by_volume} of the volume and {by_number} of the cells{where}"
    if len(ranked) == 1:
        return f"in the mesh{'es' * (len(ranked[0].meshes) > 1)} along {_named(results, best)}, {worth} {cite}"
    if not others:
        return f"no field leads to a better mesh than another: with each of the {len(best)}, {worth} {cite}"
    low, high = (f"{100 * end(line.shares[0] for line in others):.1f}" for end in (min, max))
    rest = f"{low} %" if low == high else f"{low} to {high} %"
    why = ""
    if others[0].shares[0] == best[0].shares[0]:
        why = "; it is the share of the cells that decides"
    head = (
        "the best mesh is"
        if len(best) == 1
        else f"the best meshes, {len(best)} that are equal to a tenth of a per cent, are"
    )
    return f"{head} along {_named(results, best)}: {worth}; with the others they are {rest} of the volume{why} {cite}"


def _failures(results: Results) -> str:
    asked = [run for run in results.runs if _mesh(run) is not None]
    errors = [mesh.error for run in asked if (mesh := _mesh(run)) is not None and mesh.error is not None]
    if not errors:
        return ""
    told = [f"“{html.escape(error)}”" for error in list(dict.fromkeys(errors))[:_MANY]]
    return f"no mesh could be made along {len(errors)} of {counted(len(asked), 'field')}: {listed(told)}"


def _mesh(run: Run) -> HexDominantFigures | None:
    return run.record.mesh if run.done else None


def _lines(results: Results) -> list[_Line]:
    """The best first."""
    if all(_mesh(run) is None for run in results.runs):
        return []
    found: dict[tuple[Setting, Method], dict[_Place, HexDominantFigures]] = {}
    for run in results.runs:
        meshes = found.setdefault((results.problem(run).setting, results.method(run)), {})
        mesh = _mesh(run)
        if mesh is not None and mesh.hex_volume_share is not None:
            meshes.setdefault((run.input, run.seed), mesh)
    wanted = {place for meshes in found.values() for place in meshes}
    lines = [_Line(*of, meshes, bool(wanted) and set(meshes) == wanted) for of, meshes in found.items()]
    return sorted(lines, key=lambda line: line.rank)


def _named(results: Results, lines: Sequence[_Line]) -> str:
    """Fields by their methods, with the boundary treatment where there are several."""
    several = len(results.settings) > 1
    names = [
        html.escape(f"{line.method.name} ({line.setting.name})" if several else line.method.name) for line in lines
    ]
    if len(names) > _MANY + 1:
        names = [*names[:_MANY], f"{len(names) - _MANY} more"]
    return listed(names)
