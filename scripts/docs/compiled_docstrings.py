"""Gives the API pages the docstrings of the compiled module: signatures come from the stub, which has none."""

import inspect
import re
import textwrap
from typing import Any

import griffe
from octafield import _core, options

FROM_CPP = re.compile(r"_(core|BOUNDARY|RECIPE|SURFACE)\.")  # as options.py writes defaults
SIGNATURE = re.compile(r"^(\d+\. )?\w+\(.*( -> .*|\*\*kwargs\))$")


def without_signatures(text: str) -> str:
    """The prose of a docstring that pybind11 has put signatures into."""
    lines = [line for line in text.splitlines() if not SIGNATURE.match(line) and line != "Overloaded function."]
    return "\n".join(lines).strip()


def fields_as_list(text: str, fields: list[str]) -> str:
    """Sentences that begin with the name of a field, or several, and a colon become items of a list."""
    name = "(?:" + "|".join(map(re.escape, fields)) + ")"
    begin = re.compile(rf"(?:^|(?<=[.;)] )|(?<=[.;)]\n))\s*({name}(?:,\s+{name})*):\s", flags=re.MULTILINE)
    paragraphs = []
    for paragraph in text.split("\n\n"):
        if fields and begin.search(paragraph):
            paragraph = re.sub(r"\n\s*", " ", begin.sub(r"\0\1\0", paragraph))
            before, *items = paragraph.split("\0")
            paragraph = "\n".join(
                [before, "", *(f"- `{n}`: {told.strip()}" for n, told in zip(items[::2], items[1::2], strict=True))]
            )
        paragraphs.append(paragraph)
    return "\n\n".join(paragraphs)


def examples_fenced(text: str) -> str:
    """Paragraphs of doctests as code, however far they are indented."""
    paragraphs = text.split("\n\n")
    for k, paragraph in enumerate(paragraphs):
        if paragraph.lstrip().startswith(">>> "):
            paragraphs[k] = f"```pycon\n{textwrap.dedent(paragraph.strip(chr(10))).rstrip()}\n```"
    return "\n\n".join(paragraphs)


class CompiledDocstrings(griffe.Extension):
    def on_package(self, *, pkg: griffe.Module, **kwargs: Any) -> None:
        stub = pkg["_core"]
        for name, signatures in stub.overloads.items():  # griffe waits for an implementation, which stubs have not
            if not signatures:
                continue
            longest = signatures[-1]
            function = griffe.Function(name, parameters=longest.parameters, returns=longest.returns)
            function.overloads = signatures
            stub.set_member(name, function)
        for name, member in stub.members.items():
            if member.is_alias or name.startswith("_") or not hasattr(_core, name):
                continue
            thing = getattr(_core, name)
            if member.is_class:
                self._describe_class(member, thing)
            elif member.is_function:
                member.docstring = griffe.Docstring(without_signatures(inspect.getdoc(thing) or ""), parent=member)
        self._lists(pkg)
        self._fence(pkg)
        for name in ("MeshOptions", "SurfaceFieldOptions", "FieldOptions"):
            self._state_defaults(pkg["options"].members[name], getattr(options, name))

    def _fence(self, thing: griffe.Module | griffe.Class) -> None:
        for member in thing.members.values():
            if member.is_alias:
                continue
            if member.docstring:
                member.docstring.value = examples_fenced(member.docstring.value)
            if member.is_module or member.is_class:
                self._fence(member)

    def _describe_class(self, member: griffe.Class, thing: type) -> None:
        """One table of the fields in place of a section for each."""
        rows = []
        for name in [n for n in member.members if not n.startswith("_")]:
            field = member.members[name]
            kind = getattr(field, "annotation", None) or getattr(field, "returns", None)
            told = without_signatures(inspect.getdoc(getattr(thing, name)) or "").replace("\n", " ").replace("|", "\\|")
            rows.append(f"| `{name}` | `{kind}` | {told} |" if kind else f"| `{name}` | | {told} |")
            del member.members[name]
        member.members.pop("__init__", None)
        table = "\n".join(["| field | type | |", "|---|---|---|", *rows])
        member.docstring = griffe.Docstring(f"{inspect.getdoc(thing)}\n\n{table}", parent=member)

    def _state_defaults(self, member: griffe.Class, thing: type) -> None:
        """Values in place of the expressions that read them from the structs of C++."""
        for parameter in member.members["__init__"].parameters if "__init__" in member.members else ():
            if FROM_CPP.match(str(parameter.default)):
                parameter.default = repr(getattr(thing, parameter.name))
        for name, attribute in member.members.items():
            if attribute.is_attribute and FROM_CPP.match(str(attribute.value)):
                attribute.value = repr(getattr(thing, name))

    def _lists(self, module: griffe.Module) -> None:
        """Of the fields of classes written in Python."""
        for member in module.members.values():
            if member.is_alias:
                continue
            if member.is_module:
                self._lists(member)
            elif member.is_class and member.docstring and member.module.name != "_core":
                fields = [name for name, field in member.members.items() if field.is_attribute]
                member.docstring.value = fields_as_list(member.docstring.value, fields)
