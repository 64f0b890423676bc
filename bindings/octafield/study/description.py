"""The file that describes a study: YAML, checked on reading, every error with its line."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import yaml
from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Discriminator,
    Field,
    Tag,
    ValidationError,
    field_validator,
    model_validator,
)

from ..domain.generators import GENERATORS
from ..errors import Error, InvalidInput, IoError
from ..hexdom.options import MESHES, HexMeshOptions
from ..options import FieldOptions, MeshOptions, did_you_mean
from ..schemes import in_folder
from ..view.captions import counted

if TYPE_CHECKING:
    from pydantic_core import ErrorDetails

_DEGREES = (
    "feature_angle",
    "feature_tolerance",
    "hold_angle",
)  # radians in the options, degrees in files and on the command line
_MESH = tuple(f.name for f in dataclasses.fields(MeshOptions))
_RUN = tuple(f.name for f in dataclasses.fields(FieldOptions) if f.name not in (*_MESH, "seed", "threads"))

_CELLS = tuple(f.name for f in dataclasses.fields(HexMeshOptions))

_MOST_SEEDS = 10_000
_DEEPEST = 20  # levels of nesting
_OURS = ("folder", "text", "origin")  # attributes of a Study that its file does not set
_TYPES = ("str", "bool", "int", "float")  # pydantic names the members of a union

Scalar = str | bool | int | float
Loc = tuple[str | int, ...]  # keys and numbers on the way to a part of the description


class _Strict(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class Generated(_Strict):
    """A model made by rule: generator, its numbers, and mesh options."""

    generator: Literal[tuple(GENERATORS)]  # type: ignore[valid-type]
    with_: dict[str, float] = Field(default_factory=dict, alias="with")
    mesh: dict[str, Scalar] = Field(default_factory=dict)

    @model_validator(mode="after")
    def _known_parameters(self) -> Generated:
        known = GENERATORS[self.generator].parameters
        for name, value in self.with_.items():
            if name not in known:
                raise ValueError(f"{self.generator} has no parameter {name!r}; it has: {', '.join(known) or 'none'}")
            if not (math.isfinite(value) and value > 0):
                raise ValueError(f"{name} must be positive, not {value!r}")
        return self


class FromFile(_Strict):
    """A path or glob, relative to the file of the study, and mesh options of its own."""

    file: str
    mesh: dict[str, Scalar] = Field(default_factory=dict)


def _kind(entry: Any) -> str | None:
    keys = entry if isinstance(entry, dict) else vars(entry) if isinstance(entry, BaseModel) else ()
    return next((f"#{key}" for key in ("file", "generator") if key in keys), None)


_Input = Annotated[
    Annotated[FromFile, Tag("#file")] | Annotated[Generated, Tag("#generator")],
    Discriminator(
        _kind, custom_error_type="input", custom_error_message="an input is a path, or a mapping with file or generator"
    ),
    BeforeValidator(lambda entry: {"file": entry} if isinstance(entry, str) else entry),
]


class Study(_Strict):
    """name: shown in reports. inputs: files, globs, generators. mesh: options of octafield.MeshOptions for all of them
    (angles in degrees). runs: options of octafield.FieldOptions, one value or a list; every combination is run, but
    those that `skip` names. seeds: a list, or how many from 0. repeats: of every run, for timings. limit: seconds after
    which a run is ended and counts as failed; None: none. fields: keep field.vtu and the .vtp files of each run.
    hex_dominant: options of octafield.HexMeshOptions: a mesh along every field; None: none. `mesh: hex-dominant` stands
        for default ones.
    folder: that relative paths begin at; text: of the file; origin: its name in messages."""

    name: str
    inputs: Annotated[list[_Input], Field(min_length=1)]
    mesh: dict[str, Scalar] = Field(default_factory=dict)
    runs: dict[str, Annotated[list[Scalar], Field(min_length=1)]] = Field(default_factory=dict)
    skip: list[dict[str, Scalar]] = Field(default_factory=list)
    seeds: Annotated[list[Annotated[int, Field(ge=0, lt=2**64)]], Field(min_length=1)] = [0]
    repeats: Annotated[int, Field(ge=1, le=1000)] = 1
    limit: Annotated[float, Field(gt=0, allow_inf_nan=False)] | None = None
    fields: bool = True
    hex_dominant: dict[str, Scalar] | None = None
    folder: Path = Field(default=Path(), exclude=True)
    text: str = Field(default="", exclude=True)
    origin: str = Field(default="study", exclude=True)

    def __repr__(self) -> str:
        """What it varies; an input may stand for several files."""
        varied = "".join(f", {name}: {', '.join(map(str, values))}" for name, values in self.runs.items())
        repeats = f", {self.repeats} repeats" if self.repeats > 1 else ""
        inputs, seeds = counted(len(self.inputs), "input"), counted(len(self.seeds), "seed")
        return f"Study({self.name}: {inputs}{varied}; {seeds}{repeats})"

    @model_validator(mode="before")
    @classmethod
    def _a_word_for_meshes(cls, content: Any) -> Any:
        if not isinstance(content, dict) or content.get("mesh") != MESHES[1]:
            return content
        return {"hex_dominant": {}, **{key: value for key, value in content.items() if key != "mesh"}}

    @field_validator("runs", mode="before")
    @classmethod
    def _one_value_is_a_list(cls, value: Any) -> Any:
        if not isinstance(value, dict):
            return value
        return {name: given if isinstance(given, list) else [given] for name, given in value.items()}

    @field_validator("seeds", mode="before")
    @classmethod
    def _a_number_counts(cls, value: Any) -> Any:
        if isinstance(value, bool) or not isinstance(value, int):
            return value
        if not 1 <= value <= _MOST_SEEDS:
            raise ValueError(f"a number of seeds lies in 1 .. {_MOST_SEEDS}; name one seed as a list: [{value}]")
        return list(range(value))


def load(path: str | Path) -> Study:
    """Reads and checks a description. Raises IoError, InvalidInput (with the line)."""
    path = Path(path)
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise IoError(f"{path}: cannot read the study ({getattr(error, 'strerror', None) or error})") from error
    return parse(text, folder=path.resolve().parent, name=str(path))


def parse(text: str, *, folder: str | Path = ".", name: str = "study") -> Study:
    """A description from text; relative paths begin at `folder`, errors at `name`."""
    try:
        _refuse_aliases_and_depth(text, name)
        tree = yaml.compose(text, Loader=yaml.SafeLoader)
        content = yaml.safe_load(text)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        line = f":{mark.line + 1}" if mark else ""
        raise InvalidInput(f"{name}{line}: {error.problem or error.context}", "bad_study") from error
    except yaml.YAMLError as error:
        raise InvalidInput(f"{name}: {error}", "bad_study") from error
    if not isinstance(content, dict):
        raise InvalidInput(f"{name}:1: a study is a mapping with the keys name, inputs, runs ...", "bad_study")
    _refuse_repeated_keys(tree, name)
    for key in _OURS:
        if key in content:
            raise InvalidInput(f"{name}:{_line(tree, (key,))}: {key}: no such key", "bad_study")
    try:
        study = Study.model_validate({**content, "folder": Path(folder), "text": text, "origin": name})
    except ValidationError as error:
        first = error.errors()[0]
        raise InvalidInput(f"{name}:{_line(tree, first['loc'])}: {_told(first)}", "bad_study") from error
    study = _with_schemes_in(study)
    _check_options(study, tree, name)
    return study


def _with_schemes_in(study: Study) -> Study:
    """FILE.py:NAME, like other files, is relative to the folder of the study."""

    def placed(key: str, value: Scalar) -> Scalar:
        return in_folder(value, study.folder) if key == "representation" else value

    runs = {key: [placed(key, value) for value in values] for key, values in study.runs.items()}
    skip = [{key: placed(key, value) for key, value in rule.items()} for rule in study.skip]
    return study.model_copy(update={"runs": runs, "skip": skip})


def place(study: Study, loc: Loc) -> str:
    """file:line of a part of the description."""
    tree = yaml.compose(study.text, Loader=yaml.SafeLoader)
    return f"{study.origin}:{_line(tree, loc)}" if tree else study.origin


def mesh_options(study: Study, entry: FromFile | Generated) -> MeshOptions:
    """Of one input: those of the study, its own in their place."""
    return MeshOptions(**_converted({**study.mesh, **entry.mesh}))


def cell_options(study: Study) -> HexMeshOptions | None:
    """Of the meshes along fields; None: none are wanted."""
    return None if study.hex_dominant is None else HexMeshOptions(**_converted(study.hex_dominant))


def field_options(mesh: MeshOptions, chosen: dict[str, Scalar], seed: int, threads: int) -> FieldOptions:
    return FieldOptions(**vars(mesh), **_converted(chosen), seed=seed, threads=threads)


def _converted(options: dict[str, Scalar]) -> dict[str, Any]:
    return {k: math.radians(v) if k in _DEGREES and isinstance(v, (int, float)) else v for k, v in options.items()}


def _check_options(study: Study, tree: yaml.Node, name: str) -> None:
    """Every option by itself: combinations that cannot be run are failures of their runs."""

    def check(
        loc: Loc, known: tuple[str, ...], options: dict[str, Scalar], make: type[MeshOptions] | type[HexMeshOptions]
    ) -> None:
        for key, value in options.items():
            try:
                if key not in known:
                    raise InvalidInput(
                        f"no option {key!r}; there are: {', '.join(known)}{did_you_mean(key, known)}", "bad_study"
                    )
                make(**_converted({key: value}))
            except (Error, TypeError) as error:
                raise InvalidInput(f"{name}:{_line(tree, (*loc, key))}: {error}", "bad_study") from error

    check(("mesh",), _MESH, study.mesh, MeshOptions)
    check(("hex_dominant",), _CELLS, study.hex_dominant or {}, HexMeshOptions)
    try:
        cell_options(study)
    except Error as error:
        raise InvalidInput(f"{name}:{_line(tree, ('hex_dominant',))}: {error}", "bad_study") from error
    for k, entry in enumerate(study.inputs):
        check(("inputs", k, "mesh"), _MESH, entry.mesh, MeshOptions)
    for key, values in study.runs.items():
        for k, value in enumerate(values):
            if value in values[:k]:
                raise InvalidInput(f"{name}:{_line(tree, ('runs', key, k))}: {value!r} is given twice", "bad_study")
            check(("runs",), _RUN, {key: value}, FieldOptions)
    for k, rule in enumerate(study.skip):
        if not isinstance(rule.get("input", ""), str):
            where = _line(tree, ("skip", k, "input"))
            raise InvalidInput(f"{name}:{where}: input is a name or glob, in quotes where it is a number", "bad_study")
        check(
            ("skip", k), ("input", *_RUN), {key: value for key, value in rule.items() if key != "input"}, FieldOptions
        )
        for key in rule:
            if key not in study.runs and key != "input":
                where = _line(tree, ("skip", k, key))
                raise InvalidInput(f"{name}:{where}: {key!r} is not among the options of runs", "bad_study")
    if len(set(study.seeds)) < len(study.seeds):
        raise InvalidInput(f"{name}:{_line(tree, ('seeds',))}: a seed is given twice", "bad_study")


def _refuse_aliases_and_depth(text: str, name: str) -> None:
    """Before a tree is made of it: what PyYAML makes of both grows without bound."""
    depth = 0
    for event in yaml.parse(text):
        if isinstance(event, yaml.AliasEvent):
            raise InvalidInput(
                f"{name}:{event.start_mark.line + 1}: write the value again in place of an alias", "bad_study"
            )
        depth += isinstance(event, yaml.CollectionStartEvent) - isinstance(event, yaml.CollectionEndEvent)
        if depth > _DEEPEST:
            raise InvalidInput(
                f"{name}:{event.start_mark.line + 1}: nested {depth} deep; a study has no more than {_DEEPEST} levels",
                "bad_study",
            )


def _refuse_repeated_keys(node: yaml.Node, name: str) -> None:
    """YAML would keep the last one silently."""
    if isinstance(node, yaml.MappingNode):
        seen = set()
        for key, value in node.value:
            if key.value in seen:
                raise InvalidInput(f"{name}:{key.start_mark.line + 1}: {key.value!r} is given twice", "bad_study")
            seen.add(key.value)
            _refuse_repeated_keys(value, name)
    elif isinstance(node, yaml.SequenceNode):
        for value in node.value:
            _refuse_repeated_keys(value, name)


def _line(node: yaml.Node, loc: Loc) -> int:
    """1-based line of the deepest node on the way that exists in the file."""
    line: int = node.start_mark.line
    for step in loc:
        if isinstance(node, yaml.MappingNode):
            found = [(key, value) for key, value in node.value if key.value == step]
            if not found:
                continue  # a part of the model that is not in the file, as the kind of an input
            line, node = found[0][0].start_mark.line, found[0][1]
        elif isinstance(node, yaml.SequenceNode) and isinstance(step, int) and step < len(node.value):
            node = node.value[step]
            line = node.start_mark.line
    return line + 1


def _keys_beside(loc: Loc) -> list[str]:
    """What a key may be at the place of one that is not known."""
    models: dict[Any, type[BaseModel]] = {"#file": FromFile, "#generator": Generated}
    model = next((models[step] for step in loc if step in models), Study)
    return [field.alias or name for name, field in model.model_fields.items() if name not in _OURS]


def _told(error: ErrorDetails) -> str:
    where = ".".join(
        str(step) for step in error["loc"] if isinstance(step, str) and step[0] not in "#[" and step not in _TYPES
    )
    message = error["msg"].removeprefix("Value error, ")
    if error["type"] == "extra_forbidden":
        return f"{where}: no such key{did_you_mean(str(error['loc'][-1]), _keys_beside(error['loc']))}"
    if error["type"] == "missing":
        return f"{where} is missing"
    return f"{where}: {message}"
