"""From a description to the list of runs, each with its key."""

import dataclasses
import fnmatch
import glob
import hashlib
import itertools
import json
import math
from collections.abc import Hashable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..errors import InvalidInput, IoError
from ..hexdom.options import HexMeshOptions
from ..options import FieldOptions
from ..progress.phases import octafield_version
from ..schemes import digest_of as scheme_digest
from ..schemes import is_in_file
from .description import FromFile, Generated, Study, cell_options, field_options, mesh_options, place
from .digests import Digests, digest_of

Source = str | dict[str, Any]


@dataclass(frozen=True)
class Run:
    """One field to compute. source: a path, or {"generator": name, "with": {...}}. name: of the input, unique in the
    study.
    key: 20 hexadecimal digits of the SHA-256 of the input's content, the options but threads, the repeat and
        octafield's version.
    hex_options: of the mesh along the field; None: none."""

    key: str
    name: str
    source: str | dict[str, Any]
    options: FieldOptions
    repeat: int
    hex_options: HexMeshOptions | None = None

    def __repr__(self) -> str:
        again = f", repeat {self.repeat}" if self.repeat else ""
        again += f", {self.hex_options!r}" if self.hex_options else ""
        return f"Run({self.key}: {self.name}, {self.options!r}{again})"

    @property
    def group(self) -> tuple[str, str]:
        """Runs of equal group share their mesh and cross field."""
        mesh = {f.name: getattr(self.options, f.name) for f in dataclasses.fields(FieldOptions) if f.name in _SHARED}
        return (self.name, json.dumps(mesh, sort_keys=True))

    def to_json(self) -> dict[str, Any]:
        cells = self.hex_options and dict(vars(self.hex_options))
        return {**vars(self), "options": dict(vars(self.options)), "hex_options": cells}

    @classmethod
    def from_json(cls, content: dict[str, Any]) -> "Run":
        cells = content["hex_options"]
        made = {"options": FieldOptions(**content["options"]), "hex_options": cells and HexMeshOptions(**cells)}
        return cls(**{**content, **made})


def mesh_of(run: Run) -> Hashable:
    """Equal for runs whose meshes have the same number of tets."""
    o = run.options
    return (
        run.name,
        o.features,
        o.feature_angle,
        o.edge_length,
        o.remesh,
        o.repair,
        o.interfaces,
        o.split,
        o.max_hole_edges,
        o.wrap_alpha,
        o.wrap_offset,
        o.max_cells,
    )


# Options younger than keys, as they were before: not in the key, so that runs of earlier studies keep theirs.
_LATER = (
    ("sizes", "none"),
    ("axes", "orthogonal"),
    ("max_hole_edges", 0),
    ("wrap_alpha", 0.0),
    ("wrap_offset", 0.0),
    ("max_cells", 0),
    ("split_singular", False),
    ("linear_solver", "default"),
    ("midpoint_limit", math.radians(20)),
    ("round_time", 0.2),
    ("first_time", 20.0),
    ("last_time", 0.25),
    ("time_exponent", 2.0),
    ("max_steps", 60),
    ("linear_tolerance", 0.1),
)
_RENAMED = {("repair", "default"): False, ("repair", "safe"): True}  # values that had other words
_SHARED = ("seed", *(f.name for f in dataclasses.fields(FieldOptions.__mro__[1])))


def plan(study: Study, *, threads: int = 1, digests: Digests | None = None) -> list[Run]:
    """Every combination, inputs outermost, in the order of the file. Raises InvalidInput where a file or glob is not
    there.
    digests: of files, kept from earlier times.

        >>> from octafield import study
        >>> text = "{name: two, inputs: [{generator: box}], runs: {representation: [sh4, su2]}, seeds: 3}"
    >>> described = study.parse(text)
        >>> [(run.name, run.options.representation, run.options.seed) for run in study.plan(described)][:2]
        [('box', 'sh4', 0), ('box', 'su2', 0)]
    """
    digests = digests or Digests()
    runs: dict[str, Run] = {}
    taken: set[str] = set()
    for entry in study.inputs:
        for source, stem, digest in _sources(study, entry, digests):
            name = _unique(stem, taken)
            for run in _runs_on(study, entry, source, name, digest, threads):
                runs.setdefault(run.key, run)  # an input that two globs name runs once
    _require_matching_rules(study, taken)
    if not runs:
        raise InvalidInput("skip leaves nothing to run; remove a rule", "bad_study")
    return list(runs.values())


def has_promised_content(run: Run) -> bool:
    """Whether the input still has the content that the key of the run stands for. Reads it."""
    try:
        digest = digest_of(Path(run.source)) if isinstance(run.source, str) else json.dumps(run.source)
    except OSError:
        return False
    return _key(digest, run.options, run.repeat, run.hex_options) == run.key


def _require_matching_rules(study: Study, names: set[str]) -> None:
    for k, rule in enumerate(study.skip):
        if "input" in rule and not any(fnmatch.fnmatchcase(name, str(rule["input"])) for name in names):
            known = ", ".join(sorted(names)[:10]) + (" ..." if len(names) > 10 else "")
            raise InvalidInput(
                f"{place(study, ('skip', k, 'input'))}: no input is called {rule['input']!r}; there are: {known}",
                "bad_study",
            )


def groups(runs: list[Run]) -> list[list[Run]]:
    """Runs that share a mesh and cross field, in their order."""
    found: dict[tuple[str, str], list[Run]] = {}
    for run in runs:
        found.setdefault(run.group, []).append(run)
    return list(found.values())


def _runs_on(
    study: Study, entry: FromFile | Generated, source: Source, name: str, digest: str, threads: int
) -> list[Run]:
    mesh = mesh_options(study, entry)
    rules = [rule for rule in study.skip if fnmatch.fnmatchcase(name, str(rule.get("input", "*")))]
    rules = [{key: value for key, value in rule.items() if key != "input"} for rule in rules]
    result, cells = [], cell_options(study)
    for seed in study.seeds:
        for values in itertools.product(*study.runs.values()):
            chosen = dict(zip(study.runs, values, strict=True))
            if any(all(chosen[key] == value for key, value in rule.items()) for rule in rules):
                continue
            options = field_options(mesh, chosen, seed, threads)
            for repeat in range(study.repeats):
                key = _key(digest, options, repeat, cells)
                result.append(Run(key, name, source, options, repeat, cells))
    return result


def _key(digest: str, options: FieldOptions, repeat: int, cells: HexMeshOptions | None) -> str:
    given = options.recorded()
    if isinstance(options.representation, str) and is_in_file(
        options.representation
    ):  # what is in the file counts, not where it lies
        given["representation"] = f"{options.scheme_name} {scheme_digest(options.representation)}"
    content = {k: _RENAMED.get((k, v), v) for k, v in given.items() if k != "threads" and (k, v) not in _LATER}
    if cells is not None:
        content["hex_options"] = dict(vars(cells))
    text = json.dumps([digest, content, repeat, octafield_version()], sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:20]


def _sources(study: Study, entry: FromFile | Generated, digests: Digests) -> Iterator[tuple[Source, str, str]]:
    """(source, stem of a name, digest of the content) of each input that an entry stands for."""
    if isinstance(entry, Generated):
        spec: dict[str, Any] = {"generator": entry.generator, "with": dict(sorted(entry.with_.items()))}
        numbers = "".join(f" {name} {value:g}" for name, value in spec["with"].items())
        yield spec, entry.generator + numbers, json.dumps(spec)
        return
    pattern = str(study.folder / entry.file)
    paths = [pattern] if Path(pattern).is_file() else sorted(glob.glob(pattern, recursive=True))
    paths = [path for path in paths if Path(path).is_file()]
    if not paths:
        raise InvalidInput(f"{entry.file}: no such file under {study.folder}", "no_such_input")
    for path in paths:
        try:
            yield path, _stem(path), digests.of(Path(path))
        except OSError as error:
            raise IoError(f"{path}: cannot read it ({error.strerror})") from error


def _stem(path: str) -> str:
    return Path(path).name.removesuffix(".gz").rsplit(".", 1)[0]


def _unique(stem: str, taken: set[str]) -> str:
    number, name = 2, stem
    while name in taken:
        number, name = number + 1, f"{stem} {number}"
    taken.add(name)
    return name
