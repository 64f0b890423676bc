"""Gives the API pages the docstrings of the compiled module: signatures come from the stub, which has none."""

import inspect
import re
from typing import Any

import griffe

from octafield import _core

SIGNATURE = re.compile(r"^(\d+\. )?\w+\(.*$")
OPTION = re.compile(r"^(\w+(?:, \w+)*): ", flags=re.MULTILINE)


def without_signatures(text: str) -> str:
    """The prose of a docstring that pybind11 has put signatures into."""
    lines = [line for line in text.splitlines() if not SIGNATURE.match(line) and line != "Overloaded function."]
    return "\n".join(lines).strip()


def as_list(text: str) -> str:
    """Lines that begin with `name: ` become items of a list."""
    first = OPTION.search(text)
    if not first:
        return text
    before, after = text[: first.start()], text[first.start() :]
    return before.rstrip("\n") + "\n\n" + OPTION.sub(r"- **\1**: ", after)


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

    def _describe_class(self, member: griffe.Class, thing: type) -> None:
        """One table of the fields in place of a section for each."""
        rows = []
        for name in [n for n in member.members if not n.startswith("_")]:
            field = member.members[name]
            kind = getattr(field, "annotation", None) or getattr(field, "returns", None)
            told = without_signatures(inspect.getdoc(getattr(thing, name)) or "").replace("\n", " ").replace("|", "\\|")
            shown = str(kind).replace("|", "\\|") if kind else ""
            rows.append(f"| `{name}` | `{shown}` | {told} |" if shown else f"| `{name}` | | {told} |")
            del member.members[name]
        member.members.pop("__init__", None)
        table = "\n".join(["| field | type | |", "|---|---|---|", *rows])
        member.docstring = griffe.Docstring(f"{inspect.getdoc(thing)}\n\n{table}", parent=member)

    def _lists(self, module: griffe.Module) -> None:
        """Option lists of classes written in Python."""
        for member in module.members.values():
            if member.is_alias:
                continue
            if member.is_module:
                self._lists(member)
            elif member.is_class and member.docstring and member.module.name != "_core":
                member.docstring.value = as_list(member.docstring.value)
