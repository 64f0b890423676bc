"""The tables of docs/records.md, made from the models of records.

PYTHONPATH=tests/python python tests/python/record_table.py      # brings the page up to date
"""

import re
import types
import typing
from pathlib import Path

from octafield.records import atlas, field, hex_dominant, hex_mesh, parts, quad_layout, quad_mesh, remesh, surface_field
from octafield.records.base import Record

PAGE = Path(__file__).parents[2] / "docs" / "records.md"
END = "<!-- end of the table -->\n"
KINDS = (
    field.FieldRecord,
    surface_field.SurfaceFieldRecord,
    hex_dominant.HexDominantRecord,
    hex_mesh.HexMeshRecord,
    hex_mesh.SeamlessMapRecord,
    quad_layout.QuadLayoutRecord,
    quad_mesh.QuadMeshRecord,
    atlas.AtlasRecord,
    remesh.RemeshRecord,
    field.RunWithField,
    field.RunWithoutField,
)
PARTS = tuple(
    one
    for one in vars(parts).values()
    if isinstance(one, type) and issubclass(one, Record) and one is not Record and one.__name__[0] != "_"
)
PLAIN = {str: "text", int: "integer", float: "number", bool: "true or false", typing.Any: "anything"}


def begin(model: type[Record]) -> str:
    return f"<!-- table of {model.__name__} -->\n"


def words_of(kind: object) -> str:
    """A type as words, models as links to their tables."""
    inner = [one for one in typing.get_args(kind) if one is not type(None)]
    if typing.get_origin(kind) in (types.UnionType, typing.Union):
        return words_of(inner[0])
    if typing.get_origin(kind) is list:
        return f"list of {words_of(inner[0])}".replace("of list of", "of lists of")
    if typing.get_origin(kind) is dict:
        return f"{words_of(inner[1])} by name"
    if isinstance(kind, type) and issubclass(kind, Record):
        return f"[{kind.__name__}](#{kind.__name__.lower()})"
    return PLAIN[kind]


def table_of(model: type[Record]) -> str:
    """A row per name in the order of the file. A study's run has those of a field, which are not said again."""
    known = field.FieldRecord.model_fields if model is field.RunWithField else {}
    text = "| name | holds | in every record | meaning |\n|---|---|---|---|\n"
    for name, always in model.order().items():
        if name not in known:
            info = model.model_fields[name]
            text += f"| `{name}` | {words_of(info.annotation)} | {'yes' if always else ''} | {info.description} |\n"
    return text


def on_page(model: type[Record]) -> str:
    text = PAGE.read_text(encoding="utf-8")
    start = text.index(begin(model)) + len(begin(model))
    return text[start : text.index(END, start)]


def section_of_parts() -> str:
    """The sections of the objects within records."""
    return "".join(f"\n### {one.__name__}\n\n{one.__doc__}\n\n{begin(one)}{table_of(one)}{END}" for one in PARTS)


if __name__ == "__main__":
    text = PAGE.read_text(encoding="utf-8")
    for model in KINDS:
        start = text.index(begin(model)) + len(begin(model))
        text = text[:start] + table_of(model) + text[text.index(END, start) :]
    head = re.match(r".*?^## Objects within records\n", text, flags=re.DOTALL | re.MULTILINE)
    PAGE.write_text(head[0] + section_of_parts(), encoding="utf-8")
